"""What Windows has not, by the "Availability" of Python's documentation."""

MODULES = ("fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty")
NAMES = {
    "os": "WEXITSTATUS WIFEXITED chown chroot confstr fchdir fchmod fchown fork forkpty getegid"
    " geteuid getgid getgroups getloadavg getpgid getpriority getsid getuid initgroups killpg"
    " lchown lockf mkfifo mknod nice openpty pathconf posix_fadvise POSIX_FADV_DONTNEED pread"
    " preadv pwrite sched_getaffinity sendfile setegid seteuid setgid setpgid setpriority setsid"
    " setuid statvfs sync sysconf uname wait wait3 wait4 waitid O_NONBLOCK O_CLOEXEC O_DIRECTORY"
    " O_NOFOLLOW O_SYNC O_DSYNC O_NOCTTY",
    "signal": "SIGALRM SIGCHLD SIGCONT SIGHUP SIGKILL SIGPIPE SIGQUIT SIGSTOP SIGTSTP SIGUSR1"
    " SIGUSR2 SIGWINCH alarm pause pthread_kill pthread_sigmask setitimer sigpending sigwait",
    "select": "poll epoll kqueue",
    "socket": "AF_UNIX",
    "time": "clock_gettime clock_settime tzset",
}
