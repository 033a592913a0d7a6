// bytes: 16 + 2 + 40 + 300 + 8 + 4
#include "simpletools.h"

struct Sample {  // 1 + 4 + 2 + 1: there are no gaps on the target
  char kind;
  int value;
  short index;
  unsigned ready : 1, late : 3;
};

struct Sample kept[2];
const int unchanged = 7;
int never_read;
char *name;
int numbers[10];
char line[300];
static double level[2];

void log_value(int value) {
  static int nobody_calls[100];
  nobody_calls[value] = value;
}

int main() {
  int i = 0;
  name = line;
  while (1) {
    kept[i & 1].value = input(i);
    kept[i & 1].ready = 1;
    numbers[i % 10] = kept[0].value + unchanged;
    level[i & 1] = numbers[3] * 0.5;
    never_read = i++;
    line[i % 300] = (char)level[0] + numbers[i % 10] + name[2] + kept[i & 1].ready;
    pause(line[numbers[2] % 300]);
  }
}
