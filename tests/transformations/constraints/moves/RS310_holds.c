#include <stdint.h>
/* Types that have their width anywhere; pointers hold no number. */
int32_t total;
short half;
void put(int32_t *place, unsigned char byte) { *place = byte + half; }
void main(void) { total = half; }
