/* mstimer.h of the Simple Libraries: a counter of milliseconds in a cog of its own. */
#ifndef MSTIMER_H
#define MSTIMER_H
#include "simpletools.h"
int mstime_start();
void mstime_stop();
int mstime_get();
void mstime_reset();
void mstime_set(int newTime);
#endif
