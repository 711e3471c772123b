#!/bin/sh
# Submits a job of Snakemake and prints its number: submit.sh <rule> <processors> <MB> <minutes> <script>. While the
# controller does not answer it is asked again, for a quarter of an hour.
set -eu
rule=$1 processors=$2 memory=$3 minutes=$4
shift 4
mkdir -p workflow/log
tries=0
until said=$(sbatch --parsable --job-name="d2b_$rule" --ntasks=1 --cpus-per-task="$processors" --mem="$memory" \
    --time="$minutes" --output=workflow/log/%x-%j.txt "$@" 2>&1); do
    tries=$((tries + 1))
    case $said in
        *"nable to contact"* | *"imed out"* | *"ocket"*) [ "$tries" -lt 90 ] ;;
        *) false ;;
    esac || { echo "$said" >&2; exit 1; }
    sleep 10
done
# "12;cluster" where there are several clusters.
echo "$said" | tail -n 1 | cut -d ';' -f 1
