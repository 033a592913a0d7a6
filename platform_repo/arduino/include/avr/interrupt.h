/* avr-libc 2.0, avr/interrupt.h: names. */
#pragma once
#include <avr/io.h>
#define sei() ((void)0)
#define cli() ((void)0)
#define reti() ((void)0)
#define ISR_BLOCK
#define ISR_NOBLOCK
#define ISR_NAKED
#define ISR_ALIASOF(v)
#define ISR(vector, ...) void vector(void)
#define SIGNAL(vector) void vector(void)
#define EMPTY_INTERRUPT(vector) void vector(void) {}
#define ISR_ALIAS(vector, target_vector) void vector(void)
