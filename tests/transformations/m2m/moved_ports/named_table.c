// expect D9=1 D8=2 D7=3
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

typedef struct { const char *name; int pin; } Entry;
static const Entry table[] = { { "red", 0 }, { "green", 1 }, { "blue", 2 } };
int find(const char *n) { for (int i = 0; i < 3; i++) if (n[0] == table[i].name[0]) return table[i].pin; return -1; }
int main() { p(find("red"), 1); p(find("green"), 2); p(find("blue"), 3); p(find("x"), 4); while(1); }
