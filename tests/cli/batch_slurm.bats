# A job array of Slurm, run by its own daemons on this machine, each with its files in the test's folder.
load helpers

setup_file() {
  export SLURM=$BATS_FILE_TMPDIR/slurm WHY_NOT=
  export SLURM_CONF=$SLURM/slurm.conf
  local program
  for program in mungekey munged slurmctld slurmd sbatch; do
    command -v $program >/dev/null || WHY_NOT="there is no $program (Debian: slurm-wlm, munge)"
  done
  [ "$(id -u)" -eq 0 ] || WHY_NOT="only root can run slurmd"
  [ -z "$WHY_NOT" ] || return 0
  start_slurm >"$BATS_FILE_TMPDIR/start.log" 2>&1 ||
    WHY_NOT="Slurm does not start here: $(tail -n 1 "$BATS_FILE_TMPDIR/start.log")"
}

start_slurm() {
  mkdir -p "$SLURM/state" "$SLURM/spool"
  chmod 755 "$SLURM"
  mungekey -c -k "$SLURM/key" || return
  munged --force --key-file="$SLURM/key" --socket="$SLURM/munge.socket" --pid-file="$SLURM/munged.pid" \
    --log-file="$SLURM/munged.log" --seed-file="$SLURM/seed" 3>&- || return
  cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=47817
SlurmdPort=47818
AuthInfo=socket=$SLURM/munge.socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmUser=root
SlurmdUser=root
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation=$SLURM/state
SlurmdSpoolDir=$SLURM/spool
SlurmctldPidFile=$SLURM/slurmctld.pid
SlurmdPidFile=$SLURM/slurmd.pid
SlurmctldLogFile=$SLURM/slurmctld.log
SlurmdLogFile=$SLURM/slurmd.log
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  slurmctld -c 3>&- && slurmd 3>&- || return
  for _ in $(seq 100); do
    sinfo -h 2>/dev/null | grep -q idle && return
    sleep 0.2
  done
  echo "no node is idle"
  return 1
}

teardown_file() {
  local daemon
  for daemon in slurmd slurmctld munged; do
    if [ -s "$SLURM/$daemon.pid" ]; then kill "$(cat "$SLURM/$daemon.pid")" 2>/dev/null || true; fi
  done
  for _ in $(seq 50); do  # they write once more
    [ -n "$(ls "$SLURM"/*.pid 2>/dev/null)" ] || break
    sleep 0.2
  done
}

@test "an array of four makes what one machine does" {
  [ -z "$WHY_NOT" ] || skip "$WHY_NOT"
  mkdir in
  for texture in "$BURNISH_SOURCE_DIR"/samples/cmake/textures/*.png; do
    for copy in 1 2 3; do cp "$texture" "in/$copy$(basename "$texture")"; done
  done
  local recipe=$BURNISH_SOURCE_DIR/samples/batch/textures.toml
  timeout 120 sbatch -W --array=0-3 --export=ALL,BURNISH_BIN="$BURNISH_BIN" "$BURNISH_SOURCE_DIR/samples/batch/slurm-array" \
    "$recipe" "$PWD/in" "$PWD/shards" >log 2>&1 || { cat log burnish-*.log; false; }
  [ "$(ls shards/*.ktx2 | wc -l)" -eq 9 ]
  for part in 0 1 2 3; do [ -s shards/build-$part-of-4.ninja ]; done
  succeeds burnish-batch "$recipe" --directory in --build-dir whole
  for file in whole/*.{png,exr,ktx2}; do same_bytes "$file" "shards/${file#whole/}"; done
}
