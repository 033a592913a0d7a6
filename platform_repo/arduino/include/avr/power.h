/* avr-libc 2.0, avr/power.h: names. */
#pragma once
#include <avr/io.h>
#define power_adc_enable() ((void)0)
#define power_adc_disable() ((void)0)
#define power_spi_enable() ((void)0)
#define power_spi_disable() ((void)0)
#define power_timer0_enable() ((void)0)
#define power_timer0_disable() ((void)0)
#define power_timer1_enable() ((void)0)
#define power_timer1_disable() ((void)0)
#define power_timer2_enable() ((void)0)
#define power_timer2_disable() ((void)0)
#define power_timer3_enable() ((void)0)
#define power_timer3_disable() ((void)0)
#define power_timer4_enable() ((void)0)
#define power_timer4_disable() ((void)0)
#define power_timer5_enable() ((void)0)
#define power_timer5_disable() ((void)0)
#define power_twi_enable() ((void)0)
#define power_twi_disable() ((void)0)
#define power_usart0_enable() ((void)0)
#define power_usart0_disable() ((void)0)
#define power_usart1_enable() ((void)0)
#define power_usart1_disable() ((void)0)
#define power_usart2_enable() ((void)0)
#define power_usart2_disable() ((void)0)
#define power_usart3_enable() ((void)0)
#define power_usart3_disable() ((void)0)
#define power_usb_enable() ((void)0)
#define power_usb_disable() ((void)0)
#define power_all_enable() ((void)0)
#define power_all_disable() ((void)0)
typedef enum {
  clock_div_1 = 0, clock_div_2 = 1, clock_div_4 = 2, clock_div_8 = 3, clock_div_16 = 4, clock_div_32 = 5, clock_div_64 = 6,
  clock_div_128 = 7, clock_div_256 = 8
} clock_div_t;
void clock_prescale_set(clock_div_t divider);
#define clock_prescale_get() ((clock_div_t)0)
