#include "simpletools.h"
#include <string.h>

struct Sample { char kind; float value; };
typedef struct { short id; float level[2]; char last; } Reading;

char message[64];
Reading readings[4];

void send(struct Sample *sample) {
  unsigned char *bytes = (unsigned char *)sample;  // RS333: (unsigned char *)sample
  for (int i = 0; i < 8; i++) print("%x", bytes[i]);
}

int main() {
  struct Sample sample = {1, 2.5};
  memcpy(message, &sample, sizeof(sample));  // RS333: sizeof(sample)
  memcpy(message + 8, readings, 4 * sizeof(Reading));  // RS333: sizeof(Reading)
  message[0] = *(char *)&readings[1];  // RS333: (char *)&readings[1]
  send(&sample);
}
