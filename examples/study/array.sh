#!/bin/bash
# A study as a Slurm array job, for sites without Dask. The folder is on a file system that all nodes see:
#   python -m lfdsim.study plan study.toml -o FOLDER
#   sbatch --array=0-99 array.sh FOLDER
#   python -m lfdsim.study collect FOLDER && python -m lfdsim.study report FOLDER
# Tasks that fail or run out of time are submitted again in the same way: what is finished is not computed again.
#SBATCH --job-name=lfdsim
#SBATCH --cpus-per-task=1
set -euo pipefail
exec python3 -m lfdsim.study run "$1" --chunk "$SLURM_ARRAY_TASK_ID" --of "$SLURM_ARRAY_TASK_COUNT" --threads "${SLURM_CPUS_PER_TASK:-1}"
