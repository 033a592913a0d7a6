// Pins under the names of the Pico SDK.
#pragma once
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#define GPIO_OUT 1
#define GPIO_IN 0
enum gpio_function {
  GPIO_FUNC_SPI = 1, GPIO_FUNC_UART = 2, GPIO_FUNC_I2C = 3, GPIO_FUNC_PWM = 4, GPIO_FUNC_SIO = 5, GPIO_FUNC_PIO0 = 6, GPIO_FUNC_PIO1 = 7,
  GPIO_FUNC_NULL = 31
};
void gpio_init(unsigned pin);
void gpio_set_function(unsigned pin, enum gpio_function function);
enum gpio_function gpio_get_function(unsigned pin);
void gpio_set_pulls(unsigned pin, bool up, bool down);
void gpio_set_input_enabled(unsigned pin, bool enabled);
static inline void gpio_pull_up(unsigned pin) { gpio_set_pulls(pin, true, false); }
static inline void gpio_pull_down(unsigned pin) { gpio_set_pulls(pin, false, true); }
static inline void gpio_disable_pulls(unsigned pin) { gpio_set_pulls(pin, false, false); }
static inline uint32_t gpio_get_all(void) { return *(volatile uint32_t *)0xd0000004; }
static inline bool gpio_get(unsigned pin) { return gpio_get_all() >> pin & 1; }
static inline void gpio_set_mask(uint32_t mask) { *(volatile uint32_t *)0xd0000014 = mask; }
static inline void gpio_clr_mask(uint32_t mask) { *(volatile uint32_t *)0xd0000018 = mask; }
static inline void gpio_xor_mask(uint32_t mask) { *(volatile uint32_t *)0xd000001c = mask; }
static inline void gpio_put(unsigned pin, bool value) { *(volatile uint32_t *)(value ? 0xd0000014 : 0xd0000018) = 1u << pin; }
static inline void gpio_set_dir_out_masked(uint32_t mask) { *(volatile uint32_t *)0xd0000024 = mask; }
static inline void gpio_set_dir_in_masked(uint32_t mask) { *(volatile uint32_t *)0xd0000028 = mask; }
static inline void gpio_set_dir(unsigned pin, bool out) { *(volatile uint32_t *)(out ? 0xd0000024 : 0xd0000028) = 1u << pin; }
static inline bool gpio_get_out_level(unsigned pin) { return *(volatile uint32_t *)0xd0000010 >> pin & 1; }
static inline unsigned gpio_get_dir(unsigned pin) { return *(volatile uint32_t *)0xd0000020 >> pin & 1; }
#ifdef __cplusplus
}
#endif
