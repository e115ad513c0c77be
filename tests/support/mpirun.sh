#!/usr/bin/env bash
# mpirun.sh PROCESSES SECONDS COMMAND...: runs a command on several processes as the tests do, and ends all of them when
# the seconds are over. Its exit code is the command's; where time ran out, one that Open MPI's version chooses: 110 by
# 4.1.4, 241 by 5.0.7, 57 by 6.0.0rc2.
set -euo pipefail
processes=$1 seconds=$2
shift 2
if [ "$(id -u)" -eq 0 ]; then  # Open MPI refuses root otherwise
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
export OMP_NUM_THREADS=1
# More processes than free cores: those that wait give way, or each message takes a slice of the scheduler's time.
exec "${FSI_MPIRUN:-mpirun}" -n "$processes" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 \
  --timeout "$seconds" "$@"
