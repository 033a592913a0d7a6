/* ping.h of the Simple Libraries: an ultrasonic ranger on one pin. */
#ifndef PING_H
#define PING_H
#include "simpletools.h"
int ping(int pin);
int ping_cm(int pin);
int ping_inches(int pin);
#endif
