#!/bin/bash
# A sweep on many nodes: sbatch sweep.sh FILE FOLDER, where all see both. Each task
# makes its shard; a task that was ended goes on where it was. Then merge.sh
# writes the table:
#
#   array=$(sbatch --parsable sweep.sh gaps.toml /shared/gaps)
#   sbatch --dependency="afterany:$array" merge.sh gaps.toml /shared/gaps
#
# Exit codes of a shard: docs/sweeps.md, "On several hosts".
#SBATCH --job-name=sofof-sweep
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --mem-per-cpu=512M
#SBATCH --requeue
set -euo pipefail
exec sofof sweep "$1" --out "$2" --quiet --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
