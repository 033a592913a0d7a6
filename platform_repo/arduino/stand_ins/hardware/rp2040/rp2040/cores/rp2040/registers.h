// Registers of the RP2040 that the stand-in uses. Source: RP2040 data sheet, "Address map" and the list of registers of each block.
#pragma once
#include <stdint.h>

inline volatile uint32_t &reg(uint32_t address) { return *(volatile uint32_t *)address; }
inline void setBits(uint32_t address, uint32_t bits) { reg(address + 0x2000) = bits; }
inline void clearBits(uint32_t address, uint32_t bits) { reg(address + 0x3000) = bits; }

constexpr uint32_t CLOCKS = 0x40008000, RESETS = 0x4000c000, IO_BANK = 0x40014000, PADS = 0x4001c000, XOSC = 0x40024000,
                   PLL_SYS = 0x40028000, PLL_USB = 0x4002c000, UART_0 = 0x40034000, UART_1 = 0x40038000, SPI_0 = 0x4003c000,
                   SPI_1 = 0x40040000, I2C_0 = 0x40044000, I2C_1 = 0x40048000, ADC = 0x4004c000, PWM = 0x40050000, TIMER = 0x40054000,
                   WATCHDOG = 0x40058000, SIO = 0xd0000000, NVIC_ENABLE = 0xe000e100, NVIC_FORGET = 0xe000e280;
constexpr uint32_t SIO_IN = SIO + 0x04, SIO_OUT = SIO + 0x10, SIO_OUT_SET = SIO + 0x14, SIO_OUT_CLEAR = SIO + 0x18, SIO_OUT_TOGGLE = SIO + 0x1c,
                   SIO_OE = SIO + 0x20, SIO_OE_SET = SIO + 0x24, SIO_OE_CLEAR = SIO + 0x28;
constexpr uint32_t TIMER_ALARM = TIMER + 0x10, TIMER_ARMED = TIMER + 0x20, TIMER_HIGH = TIMER + 0x24, TIMER_LOW = TIMER + 0x28,
                   TIMER_RAISED = TIMER + 0x34, TIMER_ENABLED = TIMER + 0x38;

enum PinFunction : uint32_t { FUNCTION_SPI = 1, FUNCTION_UART = 2, FUNCTION_I2C = 3, FUNCTION_PWM = 4, FUNCTION_SIO = 5, FUNCTION_NONE = 31 };

inline uint32_t pad(int pin) { return PADS + 4 + 4 * pin; }
inline uint32_t pinControl(int pin) { return IO_BANK + 4 + 8 * pin; }
void selectFunction(int pin, PinFunction function);  // with the input buffer on and the output allowed
void enableInterrupt(int number);
void handleAlarm(int alarm, void (*handler)());
