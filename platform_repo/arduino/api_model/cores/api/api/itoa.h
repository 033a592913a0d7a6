// Where cores on ArduinoCore-API declare the conversions of numbers; here Arduino.h does.
#pragma once
#include "../Arduino.h"
