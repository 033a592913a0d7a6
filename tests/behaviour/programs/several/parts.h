#ifndef PARTS_H
#define PARTS_H
struct box { int left; unsigned char right; };
extern struct box box;
int first(int n);
int second(int);
void show(void);
#define AREA (300 * 300)
static inline int twice(int v) { return v * 2; }
#endif
