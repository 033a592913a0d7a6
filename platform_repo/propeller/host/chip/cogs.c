/* Cogs as coroutines over virtual time: the one with the smallest time runs, so that runs repeat exactly.
 * The user's program is compiled with a hook in each basic block (-fsanitize-coverage=trace-pc): each costs a nominal time, so
 * that loops without any call make progress and let others run. */
#include <signal.h>
#include <stdlib.h>
#include <sys/time.h>
#include "chip.h"

/* Saves the running context's registers on its stack and its stack pointer in *from, and goes on with the other context. The C
 * library's swapcontext asks the system for the signal mask, which the sandbox forbids. */
void context_switch(void **from, void *to);
__asm__(".text\ncontext_switch:\n"
        "  pushl %ebp\n  pushl %ebx\n  pushl %esi\n  pushl %edi\n"
        "  movl 20(%esp), %eax\n  movl 24(%esp), %edx\n  movl %esp, (%eax)\n  movl %edx, %esp\n"
        "  popl %edi\n  popl %esi\n  popl %ebx\n  popl %ebp\n  ret\n");

struct cog cogs[COGS];
int running;
host_time horizon, next_wake;
static int started;
static host_time bound;  /* the running cog may go on until then */
static unsigned locks_given, locks_set;

static void finish_or_sync(host_time limit) {
  if (limit >= horizon) {
    cogs[running].now = horizon;
    host_end("running", "");
  }
  link_sync(limit, RECORD_SYNC, 0, 0);
}

static int earliest(void) {
  int best = -1;
  for (int i = 0; i < COGS; i++)
    if (cogs[i].used && !cogs[i].asleep && (best < 0 || cogs[i].now < cogs[best].now)) best = i;
  return best;
}

/* The cog that is to run next; what the world and the counters do before is done. Ends the run when nothing is left to do. */
static int next_cog(void) {
  for (;;) {
    int best = earliest();
    if (best < 0) host_end("finished", "");
    host_time when = cogs[best].now, toggle = pins_next(), ahead = pins_ahead();
    host_time world = next_wake < horizon ? next_wake : horizon;
    if (toggle < when && toggle < world && toggle < ahead) pins_advance(toggle);
    else if (ahead <= when && ahead < world) pins_reach(ahead);
    else if (world <= when) finish_or_sync(world);
    else return best;
  }
}

static void set_bound(void) {
  bound = next_wake < horizon ? next_wake : horizon;
  host_time toggle = pins_next();
  if (toggle < bound) bound = toggle;
  if (pins_ahead() < bound) bound = pins_ahead();
  for (int i = 0; i < COGS; i++)
    if (i != running && cogs[i].used && !cogs[i].asleep && cogs[i].now < bound) bound = cogs[i].now;
}

void cogs_reschedule(void) {
  int old = running, best = next_cog();
  running = best;
  set_bound();
  if (best != old) context_switch(&cogs[old].context, cogs[best].context);
}

static void advance(host_time ticks) {
  cogs[running].now += ticks;
  if (cogs[running].now >= bound) cogs_reschedule();
}

void cogs_wake(struct cog *cog, host_time when) {
  cog->wait_mask = 0;
  cog->wait_console = 0;
  if (cog->now > when) cog->now = when;
  bound = 0;
}

void cogs_look(void) { bound = 0; }

/* Drivers of libraries in cogs of their own are machine code that keeps its time: they vary in no run. */
host_time vary(host_time ticks, double factor) {
  if (factor == 0 || !cogs[running].of_program) return ticks;
  double varied = ticks * (1 + factor * link_noise());
  return varied < 1 ? 1 : (host_time)varied;
}

void __sanitizer_cov_trace_pc(void) {
  if (!started) return;
  cogs[running].of_program = 1;
  pins_commit();
  advance(vary(settings.block_ticks, settings.noise));
}

int cogs_started(void) { return started; }

host_time host_now(void) { return cogs[running].now; }

extern char __start_program_text[] __attribute__((weak)), __stop_program_text[] __attribute__((weak));

static int in_program(const char *place) { return place >= __start_program_text && place < __stop_program_text; }

static void tell_from(const char *from, void *const *frame, int prints) {
  for (int depth = 0; depth < 40 && guard_on_stack(running, frame); depth++) {
    const char *back = frame[1];
    if (in_program(back)) {
      if (from) link_record(cogs[running].now, RECORD_CALL, (unsigned)back, (unsigned)from, prints);
      return;
    }
    from = back;
    if ((void *const *)*frame <= frame) return;
    frame = *frame;
  }
}

/* Tell which call of the program the running cog is in: where in the program, where in what was called, and whether it prints. */
void tell_call(void *const *frame, int prints) {
  if (cogs[running].now >= settings.calls_from) tell_from(0, frame, prints);
}

/* Tell where the running cog is, as a call: in the program itself, or in what it called. */
void tell_place(const char *place, void *const *frame) {
  if (in_program(place)) link_record(cogs[running].now, RECORD_CALL, (unsigned)place + 1, (unsigned)place, 0);
  else tell_from(place, frame, 0);
}

void host_call(void) {
  tell_call(__builtin_frame_address(0), 0);
  pins_commit();
  advance(vary(settings.call_ticks, settings.noise));
}

void host_spend(host_time ticks) {
  tell_call(__builtin_frame_address(0), 0);
  pins_commit();
  advance(ticks);
}

host_time host_clock_ahead(void) { return (host_time)(settings.clock_us * HOST_TICKS_PER_US); }

void host_send_for(host_time ticks) { host_spend((host_time)(ticks * (1 - settings.line_part))); }

void host_turns(unsigned turns) { host_spend((host_time)turns * settings.block_ticks); }

void host_sleep_until(host_time when) {
  tell_call(__builtin_frame_address(0), 0);
  pins_commit();
  if (settings.early_part > 0 && cogs[running].of_program && when > cogs[running].now)
    when -= (host_time)((when - cogs[running].now) * settings.early_part);
  if (settings.late_us > 0 && cogs[running].of_program) when += (host_time)(settings.late_us * HOST_TICKS_PER_US * (1 + link_noise()) / 2);
  advance(when > cogs[running].now ? when - cogs[running].now : 0);
}

unsigned host_counter(void) {
  pins_commit();
  advance(64);
  return (unsigned)cogs[running].now;
}

void host_wait_counter(unsigned target) {
  tell_call(__builtin_frame_address(0), 0);
  pins_commit();
  advance(target - (unsigned)cogs[running].now);
}

/* ---- starting and stopping */

/* Leave the running context for good. */
static void leave(void) __attribute__((noreturn));
static void leave(void) {
  void *gone;
  running = next_cog();
  set_bound();
  context_switch(&gone, cogs[running].context);
  for (;;) {}
}

static void ended(void) __attribute__((noreturn));
static void ended(void) {
  cogs[running].used = 0;
  pins_cog_stopped(&cogs[running]);
  leave();
}

/* The C library's start-up code puts the cog to sleep when main has ended (crtend.S: waitpeq): its outputs stay as they are. */
void host_sleep_for_ever(void) {
  pins_commit();
  cogs[running].asleep = 1;
  leave();
}

static void body(void) {
  struct cog *cog = &cogs[running];
  cog->function(cog->parameter);
  pins_commit();
  ended();
}

static void prepare(int number, void (*function)(void *), void *parameter, host_time now) {
  struct cog *cog = &cogs[number];
  unsigned *top = guard_stack_top(number);
  *cog = (struct cog){.used = 1, .now = now, .function = function, .parameter = parameter};
  *--top = 0;  /* body never returns */
  *--top = (unsigned)body;
  cog->context = top - 4;  /* and four registers */
}

int host_start(void (*function)(void *), void *parameter, int number) {
  enum { LOADING = 8000 };  /* ticks: a cog begins with its kernel loaded into it */
  pins_commit();
  for (int i = 0; number < 0 && i < COGS; i++)
    if (!cogs[i].used) number = i;
  if (number < 0 || number >= COGS) return -1;
  if (number == running) {  /* a cog that is started anew by itself never comes back */
    pins_cog_stopped(&cogs[number]);
    prepare(number, function, parameter, cogs[running].now + LOADING);
    leave();
  }
  if (cogs[number].used) pins_cog_stopped(&cogs[number]);
  prepare(number, function, parameter, cogs[running].now + LOADING);
  bound = 0;
  return number;
}

void host_stop(int number) {
  pins_commit();
  if (number < 0 || number >= COGS || !cogs[number].used) return;
  if (number == running) ended();
  cogs[number].used = 0;
  pins_cog_stopped(&cogs[number]);
}

int host_self(void) { return running; }

int host_lock_new(void) {
  for (int i = 0; i < 8; i++)
    if (!(locks_given >> i & 1)) {
      locks_given |= 1u << i;
      return i;
    }
  return -1;
}

void host_lock_return(int number) { locks_given &= ~(1u << (number & 7)); }

int host_lock_set(int number) {
  host_spend(settings.block_ticks);
  int before = locks_set >> (number & 7) & 1;
  locks_set |= 1u << (number & 7);
  return -before;
}

int host_lock_clear(int number) {
  int before = locks_set >> (number & 7) & 1;
  locks_set &= ~(1u << (number & 7));
  return -before;
}

/* An empty endless loop has no basic block with a hook. A cog that uses the machine's time without moving its own can do nothing
 * any more: it is set aside, and its pins stay as they are. */
static void watch(int signal) {
  static host_time last_time;
  static int last_cog = -1, last_turns;
  (void)signal;
  if (running != last_cog || cogs[running].now != last_time) {
    last_cog = running, last_time = cogs[running].now, last_turns = 0;
    return;
  }
  if (++last_turns < 2) return;
  last_cog = -1;
  pins_commit();
  cogs[running].now = HOST_NEVER;
  leave();
}

void cogs_watch(void) {
  struct sigaction action = {.sa_handler = watch, .sa_flags = SA_NODEFER | SA_RESTART};
  struct itimerval every = {{0, 5000}, {0, 5000}};
  sigaction(SIGVTALRM, &action, 0);
  setitimer(ITIMER_VIRTUAL, &every, 0);
}

void cogs_begin(void (*function)(void *)) {
  prepare(0, function, 0, 0);
  running = 0;
  started = 1;
  leave();
}
