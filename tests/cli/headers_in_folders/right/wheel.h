#ifndef RIGHT_WHEEL_H
#define RIGHT_WHEEL_H
#include "../left/wheel.h"
#undef TICKS_PER_TURN
#define TICKS_PER_TURN 10
int right_turns(int ticks);
#endif
