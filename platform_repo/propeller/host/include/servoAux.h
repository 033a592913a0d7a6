/* servoAux.h of the Simple Libraries: servos with pulses in the background. */
#ifndef ROBOSMI_SERVOAUX_H
#define ROBOSMI_SERVOAUX_H
#include "simpletools.h"
int servoAux_angle(int pin, int degreeTenths);
int servoAux_speed(int pin, int speed);
int servoAux_setRamp(int pin, int stepSize);
int servoAux_set(int pin, int time);
int servoAux_get(int pin);
int servoAux_disable(int pin);
void servoAux_stop(void);
#endif
