#!/usr/bin/env bash
# A cluster of Slurm on this machine, for as long as a command runs: munged, slurmctld and a slurmd for each node, on loopback
# alone, with all that they write in one fresh folder.
#
#   cluster.sh DIR NODES COMMAND …    NODES of two processors each: n1, n2 …; COMMAND finds SLURM_CONF
#   cluster.sh lost NODE              within COMMAND: ends a node and what runs on it as a loss of power would
#
# At the end all processes of this cluster are ended, by their numbers: those that carry its mark in their environment, and no
# others.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin

# Numbers of the processes that have each of these lines in their environment.
marked() {
  local process line
  for process in /proc/[0-9]*; do
    for line in "$@"; do
      grep -qszFx -- "$line" "$process/environ" || continue 2
    done
    [ "${process#/proc/}" = $$ ] || [ "${process#/proc/}" = "$BASHPID" ] || echo "${process#/proc/}"
  done
}

# Numbers of the slurmstepd that these processes run under, whose environment Slurm clears.
keepers() {
  local process parent
  for process in "$@"; do
    parent=$(awk '/^PPid:/ { print $2 }' "/proc/$process/status" 2>/dev/null) || continue
    if [[ $(cat "/proc/$parent/comm" 2>/dev/null) == slurmstepd* ]]; then echo "$parent"; fi
  done | sort -u
}

if [ "${1-}" = lost ]; then
  # Who would report the end of the jobs ends before them, as in a loss of power.
  jobs=$(marked "GONIO_CLUSTER=$GONIO_CLUSTER" "SLURMD_NODENAME=$2")
  kill -9 $(marked "GONIO_CLUSTER=$GONIO_CLUSTER" "GONIO_NODE=$2") $(keepers $jobs) $jobs 2>/dev/null || true
  exit
fi

at=$(cd "$1" && pwd) nodes=$2 user=$(id -un)
shift 2
mkdir -p "$at"/{munge,state,log}
umask 077
head -c 1024 /dev/urandom >"$at/munge/key"

# A port that nobody listens at, for slurmctld and each node one after the other.
port=$((20000 + $$ % 20000))
taken() { (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
for ((i = 0; i <= nodes; ++i)); do
  if taken $((port + i)); then port=$((port + i + 1)) i=-1; fi
done

{
  cat <<CONF
ClusterName=gonio
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
# A job that lost its node is begun again when its credential has expired.
AuthInfo=socket=$at/munge/socket,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,bf_interval=2
SlurmdTimeout=5
KillWait=2
MinJobAge=3600
SlurmdParameters=config_overrides
StateSaveLocation=$at/state
SlurmdSpoolDir=$at/spool.%n
SlurmctldPidFile=$at/slurmctld.pid
SlurmdPidFile=$at/%n.pid
SlurmctldLogFile=$at/log/slurmctld
SlurmdLogFile=$at/log/%n
CONF
  for ((i = 1; i <= nodes; ++i)); do
    echo "NodeName=n$i NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + i)) CPUs=2 RealMemory=1000 State=UNKNOWN"
  done
  echo "PartitionName=fit Nodes=ALL Default=YES MaxTime=60 State=UP"
} >"$at/slurm.conf"
printf 'CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n' >"$at/cgroup.conf"

export GONIO_CLUSTER=$at SLURM_CONF=$at/slurm.conf
stop() {
  local round process all
  for round in TERM TERM KILL; do
    all=$(marked "GONIO_CLUSTER=$at")
    for process in $(keepers $all) $all; do kill -s $round "$process" 2>/dev/null || true; done
    for _ in $(seq 30); do
      [ -n "$(marked "GONIO_CLUSTER=$at")" ] || return 0
      sleep 0.1
    done
  done
}
trap stop EXIT
trap 'exit 1' HUP INT TERM

munged --foreground --force --key-file="$at/munge/key" --socket="$at/munge/socket" --pid-file="$at/munge/pid" \
  --log-file="$at/log/munge" --seed-file="$at/munge/seed" >"$at/log/munge.out" 2>&1 &
for _ in $(seq 50); do [ -S "$at/munge/socket" ] && break; sleep 0.1; done
slurmctld -D -c >"$at/log/slurmctld.out" 2>&1 &
for ((i = 1; i <= nodes; ++i)); do
  mkdir -p "$at/spool.n$i"
  GONIO_NODE=n$i slurmd -D -N "n$i" >"$at/log/n$i.out" 2>&1 &
done
idle() { [ "$(sinfo -h -N -t idle 2>/dev/null | wc -l)" = "$nodes" ]; }
for _ in $(seq 150); do idle && break; sleep 0.2; done
if ! idle; then
  echo "the nodes did not come up:" >&2
  tail -n 5 "$at"/log/* >&2
  exit 1
fi
"$@"
