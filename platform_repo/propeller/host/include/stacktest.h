/* stacktest.h of the Simple Libraries: how much stack a cog uses. */
#ifndef ROBOSMI_STACKTEST_H
#define ROBOSMI_STACKTEST_H
#include "simpletools.h"
int *cog_runStackTest(void (*function)(void *par), int stacksize);
int cog_endStackTest(int *coginfo);
int cogstart_stackTest(void (*func)(void *), void *par, void *stack, size_t stacksize);
int cogstop_stackTest(int cog, void *stack);
#endif
