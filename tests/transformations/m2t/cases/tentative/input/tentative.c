#include "simpletools.h"

int counter;
int counter = 5;
static int flag;
static int flag;
extern int elsewhere;
extern int board[];
extern volatile int later;
volatile int later = 2;

int main()
{
  while (1) {
    counter += flag + elsewhere + later;
    board[0] = counter;
    pause(counter);
  }
}
