#!/usr/bin/env bash
# The two commands of README.md on Debian 13, as a newcomer types them: in a root folder that debootstrap makes (as root), with a copy of this
# tree and nothing else installed.
#
#    debian13.sh quick|whole|root WORK_FOLDER
#
# quick: the first command, the unit tests, the decks against their references. whole: both commands, with PETSC where it can be installed.
# root: makes the root folder alone, for a later run of one of the other two.
# DEBIAN13_ROOT: the root folder; one that is there is used as it is, so that the next run need not make it. The last line is
# `N passed, N failed`; a part that cannot run on this machine is named in a line `skipped: WHAT: WHY`.
set -u
how=$1 work=$2
root=${DEBIAN13_ROOT:-$work/debian13}
first=$(grep -m 1 '^apt-get update' README.md)
passed=0 failed=0 steps=0

skip() {
   echo "skipped: Debian 13: $1"
   echo '0 passed, 0 failed'
   exit 0
}

# step TITLE COMMAND: a command inside the root, in the folder of the tree. Its last count, or its status, is added to the sum; a
# warning of the compiler in src is a failure.
step() {
   local log=$work/step$((++steps)).log start=$SECONDS status counts
   unshare --mount bash -c '
      mount --bind /proc "$0/proc" && mount --rbind /dev "$0/dev" && mount --bind /sys "$0/sys" &&
      exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive CI="$3" bash -c "cd $1; $2"' \
      "$root" /root/jointfem "$2" "${CI:-}" > "$log" 2>&1 < /dev/null
   status=$?
   counts=$(grep -E '^[0-9]+ passed, [0-9]+ failed' "$log" | tail -n 1)
   [ -n "$counts" ] || { [ $status -eq 0 ] && counts='1 passed, 0 failed' || counts='0 passed, 1 failed'; }
   set -- "$1" $counts
   passed=$((passed + $2)) failed=$((failed + $4))
   [ $status -eq 0 ] || [ "$4" -gt 0 ] || failed=$((failed + 1))
   if grep -A 6 -E '^(src|build/manual)/[^ ]+:[0-9]+:[0-9]+:' "$log" | grep -m 3 '^Warning:'; then failed=$((failed + 1)); fi
   [ $status -eq 0 ] || { grep -nE 'FAILED|Error|^E:|\*\*\*' "$log" | head -n 30; tail -n 15 "$log"; }
   echo "Debian 13: $1: status $status, $2 passed, $4 failed, $((SECONDS - start)) s"
}

mkdir -p "$work"
if [ ! -x "$root/usr/bin/apt-get" ]; then
   [ "$(id -u)" -eq 0 ] || skip 'debootstrap needs root'
   command -v debootstrap > /dev/null || skip 'there is no debootstrap: apt-get install debootstrap'
   mirror=$(grep -rhoE 'https?://[^ ]*/debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d 2> /dev/null | head -n 1)
   debootstrap --variant=minbase --include=ca-certificates trixie "$root" ${mirror:-http://deb.debian.org/debian} > "$work/debootstrap.log" 2>&1 ||
      skip "debootstrap has failed: $(tail -n 1 "$work/debootstrap.log")"
fi
[ "$how" != root ] || exit 0
unshare --mount true 2> /dev/null || skip 'no file systems may be mounted here'
rm -rf "$root/root/jointfem"
mkdir -p "$root/root/jointfem"
cp -R Makefile README.md src input tests reference_output "$root/root/jointfem"

step 'the first command' "$first"
case $how in
quick)
   step 'decks against their references' 'make check'
   step 'unit tests' 'make unit-test CHECKED=release' # of the objects of the first command: one compilation of src less
   ;;
whole)
   step 'PETSc' 'apt-get install -y libpetsc-real-dev pkg-config'
   step 'the second command' 'make test'
   ;;
esac
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
