#include <Arduino.h>

int fromModule() { return digitalRead(2); }
