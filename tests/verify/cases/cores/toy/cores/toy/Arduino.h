#pragma once
#include "pins_arduino.h"
#ifdef __cplusplus
extern "C" {
#endif
void say(const char *text);
void setup(void);
void loop(void);
#ifdef __cplusplus
}
#endif
