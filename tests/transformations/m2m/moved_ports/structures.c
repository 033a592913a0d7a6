// expect D9=1 D8=2 D7=3 D6=4
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

struct led { int pin; int count; };
typedef struct { char tag; struct led inner[2]; } Group;
struct led one = { 0, 1 };
Group g = { 'a', { { 1, 2 }, { .pin = 2, .count = 3 } } };
int main() { struct led d; d.pin = 3; d.count = 4; p(one.pin, one.count); for (int i=0;i<2;i++) p(g.inner[i].pin, g.inner[i].count); struct led *q = &d; p(q->pin, q->count); while(1); }
