#include "simpletools.h"
#include <stdlib.h>
#include <string.h>

struct Packed { char kind, last; short value; float level; };
struct Gaps { char kind; float value; };

struct Packed packed;
struct Gaps many[5];
char message[64];

int main() {
  struct Gaps *more = malloc(3 * sizeof(struct Gaps));
  memcpy(message, &packed, sizeof(packed));
  for (int i = 0; i < sizeof(many) / sizeof(many[0]); i++) many[i].value = i;
  more[0] = many[1];
  unsigned char *bytes = (unsigned char *)&packed;
  print("%d %f\n", bytes[0], more[0].value);
}
