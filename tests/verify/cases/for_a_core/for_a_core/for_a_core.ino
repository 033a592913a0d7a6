#include <Lamp.h>
#include "made.h"

#define TEXT(x) TEXT_OF(x)
#define TEXT_OF(x) #x
#if !defined ARDUINO_TOY_HOST || !defined ARDUINO_ARCH_TOY || MADE != 7
#error "the recipes of the core were not followed"
#endif

void setup() {
    say(TEXT(F_CPU) " " BOARD_NAME);
    if (lampOn(1) != 6) {
        say("no lamp");
    }
}

void loop() {}
