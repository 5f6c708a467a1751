#!/bin/bash
# A campaign as jobs of GNU parallel, each a shard of the seeds on one core; then the tables are put together.
#
#   missions/cluster/parallel.sh 8 missions/duck_single.alb 1..2000 results/duck
#
# It writes results/duck.csv. Whoever interrupts it starts it again: each shard goes on after its last whole row. Further arguments are those of
# `albacore campaign`: --in, --set, --fault, --reports. PARALLEL has more options, such as `--sshloginfile hosts --wd .` for several computers.
set -eu
shards=$1 script=$2 seeds=$3 folder=$4
shift 4
albacore=${ALBACORE:-albacore}
mkdir -p "$folder"
# Each argument reaches the program as it was given: what a shell would read in it is quoted.
seq -f %04g "$shards" | parallel --quote --halt now,fail=1 "$albacore" campaign "$script" --seeds "$seeds" \
    --shard "{= s/^0+// =}/$shards" --threads 1 --resume --out "$folder/part-{}.csv" "$@" > "$folder/summaries.txt"
exec "$albacore" campaign merge "$folder"/part-*.csv --seeds "$seeds" --out "$folder.csv"
