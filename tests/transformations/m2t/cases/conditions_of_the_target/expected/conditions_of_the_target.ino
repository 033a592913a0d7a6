// conditions_of_the_target: conditions_of_the_target.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <limits.h>

#include "adapters.h"

#if 0 /* ifdef ARDUINO */
#define LED 13
#define MS 100
#else
#define LED 5
#define MS 500
#endif
#if 1 /* if INT_MAX > 40000 */
int32_t wide = 1;
#elif defined(OTHER)
int32_t wide = 2;
#else
int32_t wide = 0;
#endif
#define OWN 3
#if 1 /* if OWN == 3 && !defined(HIGH) */
int32_t own = 3;
#endif
#if 0 /* ifdef __AVR__ */
#define WHERE 1
#else
#define WHERE 2
#endif
#if 0 /* ifdef __cplusplus */
int32_t lang = 1;
#else
int32_t lang = 2;
#endif
#ifdef DEBUG
int32_t debug;
#endif
#if 1 /* ifdef __PROPELLER__ */
int32_t prop = 7;
#else
int32_t prop = 8;
#endif
#ifdef __cplusplus
#endif
int32_t f(void);
#ifdef __cplusplus
#endif
#if 1 /* if !defined(__cplusplus) && !defined(min) */
int32_t plain = 5;
#endif
#if 1 /* if __LINE__ == 50 */
int32_t line = 5;
#else
int32_t line = 6;
#endif
int32_t f(void) { return wide + own + prop + plain + line + WHERE + lang; }
void setup() {

}

void loop() {
  high(port(LED)); pause(MS); print("%d\n", f());
}
