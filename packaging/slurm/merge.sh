#!/bin/bash
# Writes the table of a sweep that sweep.sh has made, and makes what is missing:
# sbatch merge.sh FILE FOLDER.
#SBATCH --job-name=sofof-merge
#SBATCH --cpus-per-task=4
#SBATCH --mem-per-cpu=512M
set -euo pipefail
exec sofof sweep "$1" --out "$2" --quiet --jobs "${SLURM_CPUS_PER_TASK:-1}"
