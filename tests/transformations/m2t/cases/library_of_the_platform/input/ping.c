#include "simpletools.h"

int ping(int pin) { return pulse_in(pin, 1); }
int ping_cm(int pin) { return ping(pin) / 58; }
int ping_inches(int pin) { return ping(pin) / 148; }
