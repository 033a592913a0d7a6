#ifndef BARE_REGISTERS_H
#define BARE_REGISTERS_H

#if defined(ARDUINO) && ARDUINO >= 100
#include <Arduino.h>
#else
#include <WProgram.h>
#endif

void begin_pulses();

#endif
