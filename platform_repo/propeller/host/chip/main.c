/* Runs the user's program, or, asked with `counters`, writes coverage files from the counters of earlier runs. */
#include <string.h>
#include <unistd.h>
#include "chip.h"

extern int prop_main(void);
extern void cogs_watch(void), pins_begin(void), __gcov_dump(void);
extern char __start_program_data[] __attribute__((weak)), __stop_program_data[] __attribute__((weak));

/* What the program has marked to run before main; the section is named so when it is linked. */
extern void (*__start_program_setup[])(void) __attribute__((weak)), (*__stop_program_setup[])(void) __attribute__((weak));

static void program(void *unused) {
  (void)unused;
  for (void (**setup)(void) = __start_program_setup; setup < __stop_program_setup; setup++) (*setup)();
  prop_main();
  host_sleep_for_ever();
}

/* Standard input holds the program's static data as a run left it; the coverage runtime writes its files from it. */
static int write_coverage(void) {
  for (char *at = __start_program_data; at < __stop_program_data;) {
    long done = read(0, at, __stop_program_data - at);
    if (done <= 0) return 1;
    at += done;
  }
  __gcov_dump();
  _exit(0);
}

int main(int count, char **arguments) {
  if (count > 1 && !strcmp(arguments[1], "counters")) return write_coverage();
  link_open();
  pins_begin();
  cogs_watch();
  guard_begin();
  cogs_begin(program);
}
