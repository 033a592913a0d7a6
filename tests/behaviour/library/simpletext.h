/* Devices for text as the platform has them, for the machine that the tests run on: one of the program's own, and no terminal. */
#include <stdint.h>
#include <stdio.h>
typedef struct text_struct {
  int (*rxChar)(struct text_struct *p);
  int (*txChar)(struct text_struct *p, int ch);
  int cogid[7];
  volatile void *devst;
  volatile int terminalEcho;
  volatile char ecA, ecB, ecsA, ecsB;
} text_t;
static int writeStr(text_t *device, char *text) {
  int count = 0;
  for (; *text; count++) device->txChar(device, *text++);
  return count;
}
static void writeDec(text_t *device, int value) {
  char digits[12];
  snprintf(digits, sizeof digits, "%d", value);
  writeStr(device, digits);
}
static int readChar(text_t *device) { return device->rxChar(device); }
