#include "fdserial.h"
#include <stdint.h>
int helper(fdserial *to) { fdserial_txChar(to, 'a'); return 3; }
int32_t wide(uint8_t x) { return x; }
