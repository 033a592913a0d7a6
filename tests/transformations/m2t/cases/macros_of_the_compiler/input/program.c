// GCC's own names have the same meaning on the target: none of them gets a placeholder.
#include "simpletools.h"

#if __GNUC__ >= 4
int version = __GNUC__ * 100 + __GNUC_MINOR__;
#endif

int main() {
  print("%d %s %d", version, __VERSION__, __CHAR_BIT__);
  return 0;
}
