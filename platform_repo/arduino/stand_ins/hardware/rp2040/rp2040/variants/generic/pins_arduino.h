// Pins of a board that is not known here: numbers are those of the microcontroller, the rest is where a Pico has it.
#pragma once
#include "../rpipico/pins_arduino.h"
