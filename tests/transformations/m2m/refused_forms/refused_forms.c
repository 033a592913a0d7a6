#include <stdio.h>
#define KIND(x) _Generic((x), int: 1, default: 2)  // told
struct message { int length; char text[]; };
struct message hello = { 2, "hi" };  // told
struct message empty = { 0 };
int sum(int n, int m, int a[n][m]) { return a[n - 1][m - 1]; }  // told
int row(int m, int (*a)[m]) { return a[0][m - 1]; }  // told
int fixed(int n, int a[n][3]) { return a[n - 1][2]; }
_Static_assert(sizeof(void *) == 4, "pointers");  // told
int (*table[2])();  // told
void (*quiet)();
enum late;  // told
enum late { EARLY, LATE };
struct made { int a; } make(void) { struct made m = { 1 }; return m; }  // told
int taken(struct own { int a; } *o) { return o->a; }  // told
struct pair { int x, y; } old = { x: 1, y: 2 };
union word { int i; char c[4]; };
typedef int T;
typedef struct node node;
struct node { node *next; };
int main(void) {
  T T = 3;  // told
  union word w = (union word)T;  // told
  int size = sizeof(struct { int a; });  // told
  int n = T ? size : w.i;
  int (*rows)[n] = 0;  // told
  int group = ({ struct { int v; } in = { 1 }; in.v; });
  struct pair p = (struct pair){ 1, 2 };
  quiet = 0;
  printf("%d %d\n", KIND(n) + group + p.x, table[0](1) + (rows == 0));
  return 0;
}
#define NAME "four"
char filled[4] = NAME;  // told
typedef int taker();  // told
typedef int (*asker)();
int one(int a) { return a; }
int two(int a, int b) { return a + b; }
int none(void) { return 0; }
taker *takers[2] = { one, two };
asker ask = none;
void early(int) __attribute__((constructor));  // told
void late_enough(void);
_Atomic int counted;  // told
static _Thread_local int mine;  // told
