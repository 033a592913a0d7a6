#pragma once
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
uint32_t time_us_32(void);
uint64_t time_us_64(void);
void busy_wait_us(uint64_t us);
void busy_wait_us_32(uint32_t us);
#ifdef __cplusplus
}
#endif
