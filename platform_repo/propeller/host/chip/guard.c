/* Stacks with guard pages, and faults that end the run with their cause. System calls, memory and processor time are limited
 * before the program starts (sandbox.c of robosmi/verify). */
#define _GNU_SOURCE
#include <signal.h>
#include <sys/mman.h>
#include <ucontext.h>
#include "chip.h"

enum { STACK = 1 << 18, PAGE = 4096, NOWHERE = 1 << 12, NEAR = 64 };
static char stacks[COGS + 1][PAGE + STACK] __attribute__((aligned(PAGE)));  /* each begins with a page that nobody may touch */
static char fault_stack[1 << 16];

unsigned *guard_stack_top(int number) { return (unsigned *)stacks[number + 1]; }

int guard_on_stack(int number, const void *where) {
  return (const char *)where >= stacks[number] + PAGE && (const char *)where < stacks[number + 1] - 8;
}

/* Whether the running cog's stack has grown into the page below it: its stack pointer is there, too. A pointer or an index that
 * runs into a page of guard, from the stack below or down its own, leaves the stack pointer where it was. */
static int stack_is_full(const char *where, const char *pointer) {
  const char *page = stacks[running];
  return where >= page && where < page + PAGE && pointer < page + PAGE + NEAR;
}

static int in_guard(const char *where) {
  for (int i = 0; i < COGS + 1; i++)
    if (where >= stacks[i] && where < stacks[i] + PAGE) return 1;
  return 0;
}

static void fault(int signal, siginfo_t *info, void *context) {
  const greg_t *registers = ((ucontext_t *)context)->uc_mcontext.gregs;
  char *where = info->si_addr;
  tell_place((const char *)registers[REG_EIP], (void *const *)registers[REG_EBP]);
  if (signal == SIGSEGV && stack_is_full(where, (const char *)registers[REG_ESP]))
    host_end("recursion", "calls that do not end use up the stack");
  if (signal == SIGSEGV && in_guard(where))
    host_end("crashed", "reaches beyond the end of a stack, as an index or a pointer without a bound does");
  if (signal == SIGFPE) host_end("crashed", "divides by zero");
  if (signal == SIGILL) host_end("crashed", "runs into what is no instruction");
  if (signal == SIGSEGV && where >= (char *)0 && where < (char *)NOWHERE)
    host_end("crashed", "uses a number below 4096 as an address, as a pointer to nothing does (on the board, the clock frequency is at 0)");
  if (signal == SIGSEGV && where == (char *)registers[REG_EIP])
    host_end("crashed", "goes on where no code is, as after a value was put beyond the end of a local array");
  host_end("crashed", "reaches for memory that is not there");
}

void guard_begin(void) {
  stack_t alternative = {.ss_sp = fault_stack, .ss_size = sizeof fault_stack};
  struct sigaction action = {.sa_sigaction = fault, .sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER};
  const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};
  for (int i = 0; i < COGS + 1; i++) mprotect(stacks[i], PAGE, PROT_NONE);
  sigaltstack(&alternative, 0);
  for (unsigned i = 0; i < sizeof faults / sizeof *faults; i++) sigaction(faults[i], &action, 0);
}
