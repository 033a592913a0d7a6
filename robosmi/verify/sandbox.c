/* The sandbox of the original program: limits this process for good, then starts the program in its place.
 *
 *   sandbox PARENT SECONDS STRICT [PROGRAM]
 *
 * PARENT is the process whose death ends the program, SECONDS its processor time. With STRICT 1 the program starts only behind the
 * filter of system calls; with 0 also on a kernel that has none. Without PROGRAM everything is done but its start.
 *
 * The filter is in force before the kernel maps the first byte of the program, so that nothing of it runs outside: no constructor,
 * resolver or relocation. The program is a static one of 32 bits, and its calls are those of i386. This launcher has 64 bits: the
 * one call that starts the program belongs to the other table of calls, names a descriptor that the start closes, and passes an
 * address above 4 GB, where no memory of a program of 32 bits can be. So the program cannot make it again, in either mode. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

enum { PROGRAM = 3, MEMORY = 1 << 28, STACK = 1 << 23 };  /* its descriptor; bytes */
enum { CLOSE_RANGE = 436, LANDLOCK_CREATE = 444, LANDLOCK_ADD = 445, LANDLOCK_RESTRICT = 446 };  /* older headers lack them */

static int strict;

static void refuse(const char *what) {
  char text[200];
  int length = snprintf(text, sizeof text, "%s (%s)", what, strerror(errno));
  if (write(2, text, (size_t)length) == length) _exit(1);
  _exit(2);
}

static void lack(const char *what) {
  if (strict) refuse(what);
}

/* ---- limits */

static void limit(int kind, rlim_t soft, rlim_t hard) {
  if (setrlimit(kind, &(struct rlimit){soft, hard})) lack("limits of resources");
}

static void limit_all(rlim_t seconds) {
  struct rlimit now;
  if (getrlimit(RLIMIT_CPU, &now)) lack("limits of resources");
  if (now.rlim_max <= seconds) seconds = now.rlim_max ? now.rlim_max - 1 : 0;
  limit(RLIMIT_CPU, seconds, seconds + 1);  /* SIGXCPU tells it from other ends */
  limit(RLIMIT_CORE, 1, 1);                 /* with 0 a helper of the system would be started */
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_MEMLOCK, 0, 0);
  limit(RLIMIT_MSGQUEUE, 0, 0);
  limit(RLIMIT_NPROC, 0, 0);
  limit(RLIMIT_STACK, STACK, STACK);
  limit(RLIMIT_AS, MEMORY, MEMORY);
}

static void close_others(void) {
  if (syscall(CLOSE_RANGE, PROGRAM, ~0u, 0) == 0) return;
  for (int each = PROGRAM, most = (int)sysconf(_SC_OPEN_MAX); each < most; each++) close(each);
}

/* ---- Landlock, where the kernel has it: no file but the program itself, to be executed; no TCP, no signal, no abstract socket */

static void deny_files(int program) {
  struct { uint64_t files, network, scoped; } denied = {(1 << 13) - 1, 0, 0};
  struct __attribute__((packed)) { uint64_t rights; int32_t folder; } own = {1 | 4, program};  /* execute, read */
  long version = syscall(LANDLOCK_CREATE, NULL, 0, 1);
  if (version < 1) return;
  if (version >= 2) denied.files |= 1 << 13;
  if (version >= 3) denied.files |= 1 << 14;
  if (version >= 5) denied.files |= 1 << 15;
  if (version >= 4) denied.network = 3;
  if (version >= 6) denied.scoped = 3;
  long rules = syscall(LANDLOCK_CREATE, &denied, version >= 6 ? 24 : version >= 4 ? 16 : 8, 0);
  if (rules < 0) {
    lack("Landlock");
    return;
  }
  if (program >= 0 && syscall(LANDLOCK_ADD, rules, 1, &own, 0)) lack("Landlock");
  if (syscall(LANDLOCK_RESTRICT, rules, 0)) lack("Landlock");
  close((int)rules);
}

/* ---- the filter of system calls */

enum { ANY = -1 };

/* What the program may call, by the numbers of i386, with the only value of an argument (0 is the first) where one is given. */
static const struct { int call, argument; unsigned value; } allowed[] = {
  {4, 0, 1},          /* write, to the pipe to the world */
  {3, 0, 0},          /* read, from the pipe of the world */
  {119, ANY, 0},      /* sigreturn */
  {173, ANY, 0},      /* rt_sigreturn */
  {1, ANY, 0},        /* exit */
  {252, ANY, 0},      /* exit_group */
  {45, ANY, 0},       /* brk */
  {125, 2, PROT_NONE}, {125, 2, PROT_READ}, {125, 2, PROT_READ | PROT_WRITE},  /* mprotect: nothing becomes code */
  {243, ANY, 0},      /* set_thread_area */
  {186, ANY, 0},      /* sigaltstack */
  {174, 0, SIGILL}, {174, 0, SIGBUS}, {174, 0, SIGFPE}, {174, 0, SIGSEGV}, {174, 0, SIGVTALRM},  /* rt_sigaction */
  {104, 0, ITIMER_VIRTUAL},  /* setitimer */
};

/* What a static C library tries when it starts or has no memory; it goes on without. Everything else ends the program. */
static const struct { int call, error; } failing[] = {
  {85, ENOSYS},       /* readlink */
  {305, ENOSYS},      /* readlinkat */
  {122, ENOSYS},      /* uname */
  {116, ENOSYS},      /* sysinfo */
  {191, ENOSYS},      /* ugetrlimit */
  {340, ENOSYS},      /* prlimit64 */
  {258, ENOSYS},      /* set_tid_address */
  {311, ENOSYS},      /* set_robust_list */
  {355, ENOSYS},      /* getrandom */
  {265, ENOSYS},      /* clock_gettime */
  {403, ENOSYS},      /* clock_gettime64 */
  {386, ENOSYS},      /* rseq */
  {462, ENOSYS},      /* mseal */
  {192, ENOMEM},      /* mmap2 */
  {91, EINVAL},       /* munmap */
  {219, EINVAL},      /* madvise */
};

static struct sock_filter steps[256];
static unsigned short size;

static void step(int code, unsigned value, int if_true, int if_false) {
  steps[size++] = (struct sock_filter){(unsigned short)code, (unsigned char)if_true, (unsigned char)if_false, value};
}

static void load(size_t place) { step(BPF_LD | BPF_W | BPF_ABS, (unsigned)place, 0, 0); }
static void compare(unsigned value, int if_true, int if_false) { step(BPF_JMP | BPF_JEQ | BPF_K, value, if_true, if_false); }
static void end(unsigned result) { step(BPF_RET | BPF_K, result, 0, 0); }

static size_t lower(int argument) { return offsetof(struct seccomp_data, args) + 8 * (size_t)argument; }
static size_t upper(int argument) { return lower(argument) + 4; }

static void require(size_t place, unsigned value) {
  load(place);
  compare(value, 1, 0);
  end(SECCOMP_RET_KILL_PROCESS);
}

/* The calls of 64 bits: the start of the program from this process, and why it failed. */
static void allow_start(const char *path) {
  const size_t call = offsetof(struct seccomp_data, nr);
  load(call);
  compare(SYS_exit_group, 0, 1);
  end(SECCOMP_RET_ALLOW);
  compare(SYS_write, 0, 4);
  load(lower(0));
  compare(2, 0, 1);  /* the start closes it */
  end(SECCOMP_RET_ALLOW);
  end(SECCOMP_RET_KILL_PROCESS);
  require(call, SYS_execveat);
  require(lower(0), PROGRAM);
  require(lower(1), (unsigned)(uintptr_t)path);
  require(upper(1), (unsigned)((uint64_t)(uintptr_t)path >> 32));
  require(lower(4), AT_EMPTY_PATH);
  end(SECCOMP_RET_ALLOW);
}

static void allow_run(void) {
  const size_t call = offsetof(struct seccomp_data, nr);
  for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++) {
    load(call);
    if (allowed[i].argument == ANY) compare((unsigned)allowed[i].call, 0, 1);
    else {
      compare((unsigned)allowed[i].call, 0, 3);
      load(lower(allowed[i].argument));
      compare(allowed[i].value, 0, 1);
    }
    end(SECCOMP_RET_ALLOW);
  }
  load(call);
  for (size_t i = 0; i < sizeof failing / sizeof *failing; i++) {
    compare((unsigned)failing[i].call, 0, 1);
    end(SECCOMP_RET_ERRNO | (unsigned)failing[i].error);
  }
  end(SECCOMP_RET_KILL_PROCESS);
}

static void filter_calls(const char *path) {
  const size_t architecture = offsetof(struct seccomp_data, arch);
  load(architecture);
  unsigned short fork = size;
  compare(AUDIT_ARCH_X86_64, 0, 0);
  allow_start(path);
  steps[fork].jf = (unsigned char)(size - fork - 1);
  require(architecture, AUDIT_ARCH_I386);
  allow_run();
  struct sock_fprog program = {size, steps};
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0)) lack("filters of system calls: seccomp");
}

/* ---- start */

int main(int count, char **arguments) {
  const char path[] = "";
  char *nothing[] = {NULL};
  if (count < 4) return 2;
  int program = -1;
  strict = atoi(arguments[3]);
  if (prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0)) lack("the end with another process: PR_SET_PDEATHSIG");
  if (getppid() != atoi(arguments[1])) return 1;
  if ((uintptr_t)path >> 32 == 0) refuse("a launcher of 64 bits");
  close_others();
  fcntl(2, F_SETFD, FD_CLOEXEC);
  if (count > 4) {
    program = open(arguments[4], O_PATH | O_CLOEXEC);
    if (program < 0) refuse("the program cannot be opened");
    if (program != PROGRAM) refuse("standard descriptors");
  }
  for (int each = 1; each < NSIG; each++) signal(each, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
  limit_all((rlim_t)atoi(arguments[2]));
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)) lack("processes without new privileges: PR_SET_NO_NEW_PRIVS");
  deny_files(program);
  filter_calls(path);
  if (program < 0) _exit(0);
  syscall(SYS_execveat, PROGRAM, path, nothing, nothing, AT_EMPTY_PATH);
  refuse("programs of 32 bits");
}
