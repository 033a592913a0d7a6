/* avr-libc 2.0, avr/sleep.h: names. */
#pragma once
#include <avr/io.h>
#define SLEEP_MODE_IDLE 0
#define SLEEP_MODE_ADC 2
#define SLEEP_MODE_PWR_DOWN 4
#define SLEEP_MODE_PWR_SAVE 6
#define SLEEP_MODE_STANDBY 12
#define SLEEP_MODE_EXT_STANDBY 14
#define set_sleep_mode(mode) ((void)(mode))
#define sleep_enable() ((void)0)
#define sleep_disable() ((void)0)
#define sleep_cpu() ((void)0)
#define sleep_mode() ((void)0)
#define sleep_bod_disable() ((void)0)
