/* avr-libc 2.0, util/atomic.h: names. */
#pragma once
#include <avr/io.h>
#include <avr/interrupt.h>
#define ATOMIC_RESTORESTATE 0
#define ATOMIC_FORCEON 1
#define NONATOMIC_RESTORESTATE 0
#define NONATOMIC_FORCEOFF 1
#define ATOMIC_BLOCK(type) for (uint8_t atomic_once = 1; atomic_once; atomic_once = 0)
#define NONATOMIC_BLOCK(type) for (uint8_t atomic_once = 1; atomic_once; atomic_once = 0)
