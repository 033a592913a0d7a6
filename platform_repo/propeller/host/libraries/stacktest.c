/* stacktest.h: cogs start and stop; how much stack they use on the Propeller is not known here. Source: libstacktest. */
#include "stacktest.h"

int *cog_runStackTest(void (*function)(void *par), int stacksize) { return cog_run(function, stacksize); }

int cog_endStackTest(int *coginfo) {
  if (!coginfo || !*coginfo) return 0;
  host_unmodelled("the stack of a cog");
}

int cogstart_stackTest(void (*func)(void *), void *par, void *stack, size_t stacksize) { return cogstart(func, par, stack, stacksize); }

int cogstop_stackTest(int cog, void *stack) {
  (void)cog, (void)stack;
  host_unmodelled("the stack of a cog");
}
