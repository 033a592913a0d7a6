/* servo.h of the Simple Libraries: servos with pulses every 20 ms from a cog of their own. */
#ifndef servo_H
#define servo_H
#include "simpletools.h"
int servo_angle(int pin, int degreeTenths);
int servo_speed(int pin, int speed);
int servo_set(int pin, int time);
int servo_setramp(int pin, int stepSize);
int servo_get(int pin);
int servo_disable(int pin);
void servo_stop(void);
#endif
