#!/bin/bash
# Holds a campaign on a one-node Slurm, of which tasks are killed and requeued, and one by GNU parallel, which is killed and started again, to the
# bytes of one process.  usage: tests/cluster/run.sh [SEEDS [MISSION]]
#
# Outside of `cargo test`: it needs slurmctld, slurmd, sbatch, munged and parallel (Debian: slurmctld slurmd slurm-client munge parallel),
# may be root, and takes minutes. It starts its own Slurm on the loopback, without systemd, and ends what it has started.
set -eu
cd "$(dirname "$0")/../.."
seeds=${1:-1..2000} mission=${2:-missions/box.alb}
cargo build --release --quiet
export ALBACORE=$PWD/target/release/albacore
work=$(mktemp -d) tasks=8
export SLURM_CONF=$work/slurm.conf

finish() {
    for daemon in slurmd slurmctld munged; do
        [ -f "$work/$daemon.pid" ] && kill "$(cat "$work/$daemon.pid")" 2> /dev/null || true
    done
    rm -rf "$work"
}
trap finish EXIT

one_node() {
    mkdir -p "$work/state" "$work/spool"
    head -c 1024 /dev/urandom > "$work/munge.key"
    chmod 400 "$work/munge.key"
    munged --force --key-file="$work/munge.key" --socket="$work/munge.sock" --pid-file="$work/munged.pid" \
        --log-file="$work/munged.log" --seed-file="$work/munge.seed"
    cat > "$SLURM_CONF" << CONF
ClusterName=desk
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
SlurmUser=root
SlurmdUser=root
AuthInfo=socket=$work/munge.sock
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ReturnToService=2
NodeName=localhost NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=desk Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
    slurmctld
    slurmd -N localhost
    for _ in $(seq 100); do
        [ "$(sinfo --noheader --format=%T 2> /dev/null)" = idle ] && return
        sleep 0.2
    done
    echo "Slurm does not come up:" && tail -n 5 "$work"/slurm*.log && exit 1
}

# So many rows are in the tables of all shards.
rows() { cat "$work/$1"/part-*.csv 2> /dev/null | grep -c -v ^scenario || true; }

# Waits until there are so many, but for the shards that run at once.
wait_for_rows() {
    for _ in $(seq 3000); do
        [ "$(rows "$1")" -ge "$2" ] && return
        sleep 0.1
    done
    echo "no $2 rows in $1" && exit 1
}

same() {
    for suffix in "" .origin .sums; do
        cmp "$work/one.csv$suffix" "$work/$1.csv$suffix"
    done
    echo "$1: the bytes of one process"
}

count=$((${seeds#*..} - ${seeds%..*} + 1))
"$ALBACORE" campaign "$mission" --seeds "$seeds" --out "$work/one.csv" > "$work/one.txt"
head -n 1 "$work/one.txt"

one_node
job=$(sbatch --parsable --array=1-$tasks --output="$work/slurm-%a.out" missions/cluster/array.sbatch "$mission" "$seeds" "$work/slurm")
for killed in 1 2 3; do
    wait_for_rows slurm $((killed * count / 20))
    task=$(squeue --noheader --states=RUNNING --array --format=%K --jobs="$job" | head -n 1)
    before=$(rows slurm)
    scontrol requeue "${job}_$task"
    echo "task $task killed and requeued, with $before of $count rows in all parts"
    # A requeued task waits two minutes, for whatever ails its node; ours is well.
    sleep 2
    scontrol update JobId="${job}_$task" StartTime=now
done
while squeue --noheader --jobs="$job" | grep -q .; do sleep 1; done
"$ALBACORE" campaign merge "$work"/slurm/part-*.csv --seeds "$seeds" --out "$work/slurm.csv"
same slurm

missions/cluster/parallel.sh $tasks "$mission" "$seeds" "$work/parallel" > "$work/parallel.txt" 2>&1 &
wait_for_rows parallel $((count / 4))
# Its jobs have process groups of their own: all of them name the folder.
pkill -KILL -f "$work/parallel"
wait $! 2> /dev/null || true
echo "parallel killed with all its jobs, with $(rows parallel) of $count rows in all parts"
missions/cluster/parallel.sh $tasks "$mission" "$seeds" "$work/parallel"
same parallel
