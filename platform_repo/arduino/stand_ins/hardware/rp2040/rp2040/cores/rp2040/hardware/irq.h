#pragma once
#include <stdbool.h>
enum { TIMER_IRQ_0 = 0, TIMER_IRQ_1, TIMER_IRQ_2, TIMER_IRQ_3, PWM_IRQ_WRAP, USBCTRL_IRQ, PIO0_IRQ_0 = 7, PIO0_IRQ_1, PIO1_IRQ_0, PIO1_IRQ_1, IO_IRQ_BANK0 = 13, UART0_IRQ = 20, UART1_IRQ };
void irq_set_exclusive_handler(unsigned number, void (*handler)());
void irq_set_enabled(unsigned number, bool enabled);
