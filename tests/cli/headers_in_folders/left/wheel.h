#ifndef LEFT_WHEEL_H
#define LEFT_WHEEL_H
#define TICKS_PER_TURN 4
int left_turns(int ticks);
#endif
