/* avr-libc 2.0, util/delay.h: names and signatures. */
#pragma once
#include <stdint.h>
void _delay_ms(double ms);
void _delay_us(double us);
void _delay_loop_1(uint8_t count);
void _delay_loop_2(uint16_t count);
