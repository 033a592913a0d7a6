/* Runs the user's program. */
#include "chip.h"

extern int prop_main(void);
extern void cogs_watch(void), pins_begin(void);

/* What the program has marked to run before main; the section is named so when it is linked. */
extern void (*__start_program_setup[])(void) __attribute__((weak)), (*__stop_program_setup[])(void) __attribute__((weak));

static void program(void *unused) {
  (void)unused;
  for (void (**setup)(void) = __start_program_setup; setup < __stop_program_setup; setup++) (*setup)();
  prop_main();
  host_sleep_for_ever();
}

/* The compiler's hooks to its coverage runtime, which is not linked: the counters leave through the pipe. */
void __gcov_init(void *object) { (void)object; }
void __gcov_exit(void) {}
void __gcov_merge_add(long long *counters, unsigned count) { (void)counters, (void)count; }

int main(void) {
  link_open();
  pins_begin();
  cogs_watch();
  guard_begin();
  cogs_begin(program);
}
