#include "motor.h"
servo_t arm;
int main() { arm.angle = nowhere(LED); pause(SPEED); motor_speed(speed_of_left, 1); }
