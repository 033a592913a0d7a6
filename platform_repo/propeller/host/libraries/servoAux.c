/* servoAux.h: the same servos as those of servo.h, in windows of 2.5 ms, two at a time. Source: libservoAux/servoAux.c. */
#include "servo.h"
#include "servoAux.h"

int servoAux_set(int pin, int time) { return servo_set(pin, time); }

int servoAux_angle(int pin, int degreeTenths) { return servoAux_set(pin, degreeTenths + 500); }

int servoAux_speed(int pin, int speed) { return servoAux_set(pin, speed + 1500); }

int servoAux_setRamp(int pin, int stepSize) { return servo_setramp(pin, stepSize); }

int servoAux_get(int pin) { return servo_get(pin); }

int servoAux_disable(int pin) { return servoAux_set(pin, 0); }  /* what its header says; the library has no body for it */

void servoAux_stop(void) { servo_stop(); }
