#!/bin/sh
# Prints the state of a job for Snakemake: running, success or failed. A job that Slurm has forgotten is said to have
# failed: it is run again, and does nothing where its files stand.
set -u
if ! said=$(squeue --noheader -t all -j "$1" -o %T 2>&1); then
    case $said in
        *"nvalid job id"*) echo failed ;;
        *) echo running ;; # the controller does not answer
    esac
    exit 0
fi
case $said in
    COMPLETED) echo success ;;
    PENDING | RUNNING | COMPLETING | CONFIGURING | SUSPENDED | STOPPED | SIGNALING | STAGE_OUT | REQUEUE* | RESIZING | RESV_DEL_HOLD | SPECIAL_EXIT)
        echo running
        ;;
    *) echo failed ;;
esac
