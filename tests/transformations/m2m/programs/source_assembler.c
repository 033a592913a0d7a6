#include "simpletools.h"

#define _text__(...) #__VA_ARGS__
#define _text_(...) _text__(__VA_ARGS__)
#define _dat_(...) __asm__(_text_(__VA_ARGS__) "\n")
#define wait_at(t) __asm__ volatile("waitcnt %0, #0" : "+r"(t))

_dat_(   max     counter, #8   );
_dat_(   mov     dira, counter /* its pins */ );

extern void other_core(void *place) __attribute__((weak));

int bits(int n) {
  int t = n;
  while (n-- > 0) {
    __asm__ volatile("waitcnt %[_t], %[_n]" /* the next bit */
                     : [_t] "+r" (t)
                     : [_n] "r" (n));
    __asm__("nop");
    __asm__ volatile("" ::: "memory");
  }
  wait_at(t);
  return t;
}

int main() {
  other_core(0);
  print("%d\n", bits(3));
  while (1) {
  }
}
