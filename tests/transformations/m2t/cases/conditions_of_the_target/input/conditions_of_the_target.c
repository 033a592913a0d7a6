#include "simpletools.h"
#include <limits.h>
#ifdef ARDUINO
#define LED 13
#define MS 100
#else
#define LED 5
#define MS 500
#endif
#if INT_MAX > 40000
int wide = 1;
#elif defined(OTHER)
int wide = 2;
#else
int wide = 0;
#endif
#define OWN 3
#if OWN == 3 && !defined(HIGH)
int own = 3;
#endif
#ifdef __AVR__
#define WHERE 1
#else
#define WHERE 2
#endif
#ifdef __cplusplus
int lang = 1;
#else
int lang = 2;
#endif
#ifdef DEBUG
int debug;
#endif
#ifdef __PROPELLER__
int prop = 7;
#else
int prop = 8;
#endif
#ifdef __cplusplus
extern "C" {
#endif
int f(void);
#ifdef __cplusplus
}
#endif
#if !defined(__cplusplus) && \
  !defined(min)
int plain = 5;
#endif
#if __LINE__ == 50
int line = 5;
#else
int line = 6;
#endif
int f(void) { return wide + own + prop + plain + line + WHERE + lang; }
int main() { while (1) { high(LED); pause(MS); print("%d\n", f()); } }
