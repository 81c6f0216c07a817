#!/usr/bin/env bash
# Install a package on a bare Debian, as a clinic would, run it as an ordinary user, and remove it again.
# Usage (as root): try-in-chroot.sh SUITE PACKAGE [CHROOT]     for example: bookworm dist/*.deb
set -euo pipefail
suite=$1 package=$(realpath "$2") root=${3:-/var/tmp/insole-studio-$1}
mirror=${MIRROR:-http://deb.debian.org/debian}

[ -x "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase "$suite" "$root" "$mirror"
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LANG=C.UTF-8 "$@"; }
unmount() { umount "$root/proc" "$root/dev/shm" 2>/dev/null || true; }
trap unmount EXIT
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
mkdir -p "$root/dev/shm"
mountpoint -q "$root/dev/shm" || mount -t tmpfs tmpfs "$root/dev/shm"

echo "== $suite: $(cat "$root/etc/debian_version"), $(inside ldd --version | head -1)"
install -m 644 "$package" "$root/tmp/insole-studio.deb"
inside apt-get update -qq
inside apt-get install -y -qq --no-install-recommends /tmp/insole-studio.deb >"$root/tmp/install.log" 2>&1 ||
    { tail -20 "$root/tmp/install.log" >&2; exit 1; }
inside test -x /usr/bin/insole-studio
inside id clinic >/dev/null 2>&1 || inside useradd --create-home clinic

as_user() { inside runuser -u clinic -- env HOME=/home/clinic "$@"; }
echo "== $(as_user insole-studio --version)"
mkdir -p "$root/home/clinic/patients" && echo kept >"$root/home/clinic/patients/somebody.insole"
if as_user insole-studio self-test --help >/dev/null 2>&1; then
    as_user sh -c 'cd && QT_QPA_PLATFORM=offscreen insole-studio self-test'
else
    as_user sh -c 'cd && insole-studio simulate session.zip && insole-studio reconstruct --out foot.ply session.zip &&
        insole-studio design --out insole.stl --job-sheet sheet.pdf session.zip' 2>"$root/tmp/chain.log" ||
        { tail -20 "$root/tmp/chain.log" >&2; exit 1; }
    as_user ls -l /home/clinic/insole.stl /home/clinic/sheet.pdf
fi
# The window itself, on a screen that only it has.
inside apt-get install -y -qq --no-install-recommends xvfb xauth >>"$root/tmp/install.log" 2>&1
as_user sh -c 'cd && QT_QPA_PLATFORM=xcb timeout 20 xvfb-run -a -s "-screen 0 1920x1200x24" insole-studio; test $? -eq 124' ||
    { echo "the window ended by itself" >&2; exit 1; }
echo "== the window stayed open for 20 s"

inside apt-get purge -y -qq insole-studio >>"$root/tmp/install.log" 2>&1
inside test ! -e /usr/lib/insole-studio
grep -q kept "$root/home/clinic/patients/somebody.insole"
echo "== removed; the patients are still there"
