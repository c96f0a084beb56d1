#!/bin/bash
# A study as a Slurm array job, for sites without Dask. The folder is on a file system that all nodes see:
#   python -m lfdsim.study plan study.toml -o FOLDER
#   sbatch --array=0-99 array.sh FOLDER
#   python -m lfdsim.study collect FOLDER && python -m lfdsim.study report FOLDER
# Tasks that fail or run out of time are submitted again, all in the same way, or some with the number of tasks that there were:
#   sbatch --array=17,40 array.sh FOLDER 100
# What is finished is not computed again.
#SBATCH --job-name=lfdsim
#SBATCH --cpus-per-task=1
set -euo pipefail
folder=$1 task=$SLURM_ARRAY_TASK_ID count=$SLURM_ARRAY_TASK_COUNT first=$SLURM_ARRAY_TASK_MIN last=$SLURM_ARRAY_TASK_MAX
# A part of an array does not say how many parts the study was divided into.
if [ $# -lt 2 ] && { [ "$first" -ne 0 ] || [ "$last" -ne $((count - 1)) ]; }; then
    echo "array.sh: error: tasks $first to $last, $count in all, are no whole array; give --array=0-$((count - 1)) for $count parts, or, to" \
        "compute parts of an array of N tasks again, N after the folder: sbatch --array=$task array.sh $folder N" >&2
    exit 2
fi
exec python3 -m lfdsim.study run "$folder" --chunk "$task" --of "${2:-$count}" --threads "${SLURM_CPUS_PER_TASK:-1}"
