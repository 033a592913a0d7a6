#include "Lamp.h"
#include <Arduino.h>

int lampOn(int pin) { return pin + LAMP_PIN; }
