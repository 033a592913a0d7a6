#include "wheel.h"
int right_turns(int ticks) { return ticks / TICKS_PER_TURN; }
