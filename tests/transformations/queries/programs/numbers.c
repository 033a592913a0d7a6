/* Each statement is an expression; behind it: its bits on a target with a 16-bit int, u for unsigned, real, or - for no number
   and for functions of which nothing is said. */
#include "simpletools.h"
#include <stdint.h>
#define SMALL 20
#define LARGE 40000
#define FAR 20L
#define SUM (SMALL + SMALL)
#define TEXT "text"
typedef int32_t wide_t;
enum mode { OFF_MODE, FAR_MODE = 70000 };
struct point { short x; long y; } where;
char c; unsigned char byte; short half; int i; unsigned u; long l; wide_t w; uint16_t fixed; float f; int *p; char s[4];
int own(void);

void all(void)
{
  1;               // 16
  40000;           // 32
  0xFFFF;          // 16 u
  1L;              // 32
  1UL;             // 32 u
  'x';             // 16
  2.5;             // real
  "text";          // -
  c;               // 8
  byte + byte;     // 16
  half * half;     // 16
  i + 1;           // 16
  i + 1L;          // 32
  i * 40000;       // 32
  u + i;           // 16 u
  u + l;           // 32
  w << 3;          // 32
  byte << 8;       // 16
  i << l;          // 16
  fixed + 1;       // 16 u
  i * f;           // real
  i < l;           // 16
  !l;              // 16
  -byte;           // 16
  ~l;              // 32
  (long)i;         // 32
  (short)l;        // 16
  p;               // -
  *p;              // 16
  s[0];            // 8
  where.x;         // 16
  where.y;         // 32
  i ? i : l;       // 32
  (i, l);          // 32
  i = l;           // 16
  sizeof(i);       // 16 u
  SMALL;           // 16
  LARGE;           // 32
  FAR;             // 32
  SUM;             // 16
  TEXT;            // -
  OFF_MODE;        // 16
  FAR_MODE;        // 32
  own();           // 16
  ping_cm(3);      // -
}
