# Slurm on this machine alone, for .ci/cluster, which reads this file: no accounting, no control groups, ports of its
# own. As root.

# slurm_up <folder>: exports SLURM_CONF
slurm_up() {
    slurm_folder=$1
    mkdir -p "$slurm_folder/state" "$slurm_folder/spool"
    chmod 755 "$slurm_folder"
    dd if=/dev/urandom of="$slurm_folder/munge.key" bs=1 count=1024 status=none
    chmod 600 "$slurm_folder/munge.key"
    munged --foreground --socket="$slurm_folder/munge.socket" --key-file="$slurm_folder/munge.key" \
        --pid-file="$slurm_folder/munged.pid" --log-file="$slurm_folder/munged.log" \
        --seed-file="$slurm_folder/munged.seed" > "$slurm_folder/munged.txt" 2>&1 &
    munged_process=$!
    export SLURM_CONF=$slurm_folder/slurm.conf
    cat > "$SLURM_CONF" <<END
ClusterName=here
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$slurm_folder/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool
SlurmctldPidFile=$slurm_folder/slurmctld.pid
SlurmdPidFile=$slurm_folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(awk '/MemTotal/ {print int($2 / 1024 * 0.9)}' /proc/meminfo) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    until [ -S "$slurm_folder/munge.socket" ]; do
        kill -0 "$munged_process"
        sleep 0.1
    done
    controller_up
    slurmd -D > "$slurm_folder/slurmd.log" 2>&1 &
    slurmd_process=$!
    # It answers within five seconds of the node's being there.
    for _ in $(seq 100); do
        [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && break
        sleep 0.2
    done
    timeout 5 srun true
}

controller_up() {
    slurmctld -D > "$slurm_folder/slurmctld.log" 2>&1 &
    controller_process=$!
}

controller_down() {
    kill "$controller_process"
    wait "$controller_process" || true
}

slurm_down() {
    scancel --full --user=root 2>/dev/null || true
    for process in ${controller_process-} ${slurmd_process-} ${munged_process-}; do
        kill "$process" 2>/dev/null || true
        wait "$process" 2>/dev/null || true
    done
}
