#!/bin/sh
# Tries peperite.sbatch against a real Slurm: one node, set up by root in a temporary directory, best in a container.
# A job on two ranks loses its node before the first checkpoint, is pre-empted, loses its node again, and is told that
# its time runs out. Each time it must go on by itself, and end with the bits of one rank that nobody disturbed.
#
#     sh benchmarks/slurm/try.sh [srun|mpirun]     about five minutes; needs build/bin/peperite
#
# Exits 0 only if all of this has happened.
set -eu
cd "$(dirname "$0")/../.."
. cmake/environment.sh
fail() {
  echo "try.sh: $1" >&2
  exit 1
}
case ${1:-srun} in
  srun) LAUNCH="srun --mpi=pmix --kill-on-bad-exit=1" ;;
  mpirun) LAUNCH=mpirun ;;
  *) fail "srun or mpirun?" ;;
esac
PEPERITE=${PEPERITE:-build/bin/peperite}
export LAUNCH PEPERITE
[ "$(id -u)" = 0 ] || fail "only root can set up a Slurm"
[ -x "$PEPERITE" ] || fail "no $PEPERITE: build first"

# --- A Slurm with everything of its own, which ends with this script ------------------------------------------------

dir=$(mktemp -d)
chmod 755 "$dir"  # munged wants its socket where all may enter
munged='' slurmctld='' slurmd='' job=''
cleanup() {
  status=$?
  trap '' INT TERM
  if [ -n "$job" ]; then
    scancel "$job" 2>/dev/null || true
    sleep 3  # its processes end before the daemons that know them
  fi
  # shellcheck disable=SC2086  # no word for a daemon that never was
  kill $slurmd $slurmctld $munged 2>/dev/null || true
  wait
  [ "$status" = 0 ] || tail -n 25 "$dir"/*.log "$dir"/*.out 2>/dev/null || true
  rm -rf "$dir"
  exit "$status"
}
trap cleanup EXIT
trap 'exit 130' INT TERM

if ! { command -v slurmctld && command -v slurmd && command -v munged; } >/dev/null; then
  echo "installing slurm-wlm and munge"
  { apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends slurm-wlm munge
  } >"$dir/apt.log" 2>&1 || fail "apt-get failed"
fi

export SLURM_CONF="$dir/slurm.conf"
host=$(hostname -s)
port=$((20000 + $$ % 10000))  # not those of a Slurm that may be here
mkdir "$dir/state" "$dir/spool" "$dir/tmp"
# What killed ranks leave behind.
export TMPDIR="$dir/tmp" OMPI_MCA_btl_vader_backing_directory="$dir/tmp"
# No cgroups; two CPUs even where there is one. A job that is requeued waits for the credential of its last start to
# expire: two minutes by default.
cat >"$SLURM_CONF" <<END
ClusterName=try
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket,cred_expire=5
SlurmUser=root
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmdLogFile=$dir/slurmd.log
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/linear
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=5,bf_interval=5
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
NodeName=$host NodeAddr=127.0.0.1 CPUs=2
PartitionName=low Nodes=$host Default=YES PriorityTier=1 PreemptMode=REQUEUE GraceTime=10
PartitionName=high Nodes=$host PriorityTier=2 PreemptMode=OFF
END
echo "PMIxCliTmpDirBase=$dir/tmp" >"$dir/mpi.conf"
start_slurmd() {
  slurmd -D >"$dir/slurmd.out" 2>&1 &
  slurmd=$!
}
mungekey --create --keyfile="$dir/munge.key"
munged --foreground --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munged.pid" \
  --seed-file="$dir/munged.seed" >"$dir/munged.log" 2>&1 &
munged=$!
slurmctld -D >"$dir/slurmctld.log" 2>&1 &
slurmctld=$!
start_slurmd

# wait_for WHAT SECONDS COMMAND...
wait_for() {
  what=$1
  end=$(($(date +%s) + $2))
  shift 2
  until "$@"; do
    [ "$(date +%s)" -lt "$end" ] || fail "waited in vain for $what"
    sleep 0.5
  done
}
node_is_idle() { [ "$(sinfo -h -p low -o %t 2>/dev/null)" = idle ]; }
wait_for "the node" 60 node_is_idle
echo "$(sinfo --version), one node; ranks are started by: $LAUNCH"

# --- The scene: as many steps as two ranks make in 90 s, for Slurm looks at time limits twice a minute only -------

scene=apps/buoyant_cylinder/fluid_fine.toml
finer="--set start.spacing=0.25"  # 48,072 particles
# fingerprint LOG: of the last state
fingerprint() { grep '^fingerprint' "$1" | tail -n 1; }

# shellcheck disable=SC2086  # $finer is two words
mpirun -n 2 "$PEPERITE" run $scene $finer --out "$dir/pace" --max-time 10 >"$dir/pace.out" 2>&1 || [ $? = 75 ] ||
  fail "no pace"
steps=$((9 * $(fingerprint "$dir/pace.out" | cut -d' ' -f4)))
# shellcheck disable=SC2086
"$PEPERITE" run $scene $finer --steps $steps --out "$dir/one" >"$dir/one.out" 2>&1 || fail "one rank failed"
expected=$(fingerprint "$dir/one.out")
echo "one rank, undisturbed: $expected"

# --- The job --------------------------------------------------------------------------------------------------------

log=$dir/job.out
: >"$log"
# shellcheck disable=SC2086
job=$(sbatch --parsable --partition=low --ntasks=2 --time=1 --signal=B:USR1@50 --output="$log" \
  benchmarks/slurm/peperite.sbatch $scene "$dir/two" $finer --steps $steps)
echo "job $job: two ranks"

said() { grep -c "$1" "$log" || true; }
state() { squeue -h -j "$job" -o %T 2>/dev/null || true; }
is_over() { [ -z "$(state)" ]; }
# The last that was said about starts is the banner of one.
is_stepping() { [ "$(grep ', start\|^from step' "$log" | tail -n 1 | cut -c1-9)" = "from step" ] || is_over; }

# Everything on the node dies at once, Slurm's daemons first, so that nobody can tell or end in good order. It comes
# back as one without a disk would: what is left of PMIx would keep the same step from starting.
lose_node() {
  pids=$(scontrol listpids "$job" | awk 'NR > 1 { print $1 }')
  for pid in $pids; do
    parent=$(sed -n 's/^PPid:[^0-9]*//p' "/proc/$pid/status" || echo none)
    [ "$(cat "/proc/$parent/comm" 2>/dev/null)" != slurmstepd ] || pids="$parent $pids"
  done
  # shellcheck disable=SC2086
  kill -9 $slurmd $pids 2>/dev/null || true
  scontrol update nodename="$host" state=down reason=try
  rm -rf "$dir/tmp"/* "$dir/spool"/*
  start_slurmd
  scontrol update nodename="$host" state=resume
  echo "try.sh, start: killed with its node" >>"$log"
}

wait_for "the first start" 60 is_stepping
sleep 1
lose_node
until [ "$(said 'job is pre-empted')" -gt 0 ] || is_over; do
  wait_for "a start" 60 is_stepping
  sleep 1
  sbatch --wait --partition=high --ntasks=2 --output=/dev/null --wrap 'sleep 1' >"$dir/sbatch.out"
done
wait_for "a start" 60 is_stepping
sleep 1
is_over || lose_node
wait_for "the end of the job" 600 is_over

# --- What happened --------------------------------------------------------------------------------------------------

sed -n 's/^\(.*, start\|from step\|peperite: \|fingerprint\)/  &/p' "$log"
starts=$(said ', start [0-9]*: starts')
lost=$(said 'killed with its node')
preempted=$(said 'exit code 75, the job is pre-empted')
timed=$(said 'got SIGUSR1')
echo "$starts starts: $lost killed with their node, $preempted pre-empted, $timed told of their time limit"
[ "$preempted" -gt 0 ] || fail "the job was not pre-empted"
[ "$timed" -gt 0 ] || fail "the job was not told of its time limit"
[ "$(fingerprint "$log")" = "$expected" ] || fail "not the bits of one rank: $(fingerprint "$log")"
echo "the bits of one rank: $expected"
