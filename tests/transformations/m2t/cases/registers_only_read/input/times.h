#include "tools.h"
#define WAIT(ticks, times) waitcnt((ticks * times) + CNT)
