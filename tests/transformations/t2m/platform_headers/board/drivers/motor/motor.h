// Without a guard, with an unknown type, and damaged in one line.
#include "board.h"
void motor_speed(motor_id which, int percent);
int motor_damaged(int a int b);
void motor_stop(void);
