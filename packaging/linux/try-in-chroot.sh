#!/usr/bin/env bash
# Install a package on a bare Debian, as a clinic would, run it as an ordinary user, and remove it again.
# Usage (as root): try-in-chroot.sh SUITE PACKAGE [ARCHIVE [CHROOT]]     for example: bookworm dist/*.deb dist/*.tar.xz
# The archive may be of another version: both then share the settings and the record of the same user.
set -euo pipefail
suite=$1 package=$(realpath "$2") archive=${3:+$(realpath "$3")} root=${4:-/var/tmp/insole-studio-$1}

[ -x "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase "$suite" "$root" ${MIRROR:+"$MIRROR"}
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
as_user sh -c 'cd && insole-studio self-test 2>self-test.log' || { tail "$root/home/clinic/self-test.log" >&2; exit 1; }
as_user insole-studio doctor 2>/dev/null

if [ -n "$archive" ]; then
    folder="$root/home/clinic/Våra program/Insole Studio – överst"
    mkdir -p "$folder"
    tar --extract --file "$archive" --directory "$folder" --strip-components=1
    unpacked="/home/clinic/Våra program/Insole Studio – överst/insole-studio"
    echo "== beside it, unpacked: $(as_user "$unpacked" --version)"
    as_user sh -c 'cd && "$0" self-test 2>self-test.log' "$unpacked" || { tail "$root/home/clinic/self-test.log" >&2; exit 1; }

    as_user sh -c 'mkdir -p ~/.config/insole-studio ~/first ~/second && rm -rf ~/.local/share/insole-studio &&
        echo "{\"theme\": \"dark\", \"of_another_version\": 1}" >~/.config/insole-studio/settings.json &&
        printf "name,birth date\nÅsa Öberg,1970-02-03\n" >~/persons.csv'
    for program in insole-studio "$unpacked" insole-studio; do
        as_user sh -c 'QT_QPA_PLATFORM=offscreen timeout 15 "$0" 2>/dev/null; test $? -eq 124' "$program"
        as_user "$program" records migrate >/dev/null
    done
    as_user insole-studio records import /home/clinic/persons.csv >/dev/null
    as_user sh -c '"$0" records list >~/first/list && insole-studio records list >~/second/list && diff ~/first ~/second' "$unpacked"
    as_user "$unpacked" records verify
    grep Öberg "$root/home/clinic/first/list"
    grep -E 'theme.*dark|of_another_version' "$root/home/clinic/.config/insole-studio/settings.json"
    echo "== both keep the same record and settings"
fi

# The window itself, on a screen that only it has.
inside apt-get install -y -qq --no-install-recommends xvfb xauth >>"$root/tmp/install.log" 2>&1
as_user sh -c 'cd && QT_QPA_PLATFORM=xcb timeout 20 xvfb-run -a -s "-screen 0 1920x1200x24" insole-studio; test $? -eq 124' ||
    { echo "the window ended by itself" >&2; exit 1; }
echo "== the window stayed open for 20 s"

inside apt-get purge -y -qq insole-studio >>"$root/tmp/install.log" 2>&1
inside test ! -e /usr/lib/insole-studio
grep -q kept "$root/home/clinic/patients/somebody.insole"
[ -z "$archive" ] || as_user "$unpacked" records list | grep Öberg
echo "== removed; the patients are still there"
