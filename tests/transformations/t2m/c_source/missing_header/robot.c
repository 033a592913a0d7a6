#include "simpletools.h"
#include "mylib.h"
int main(){ grid[0][0]=1; pts[2].x = 3; rows[1]->next = 0; *total = 5; speed=3; int k = cube[1][2][3] + *total; for(int i=0;i<speed;i++){ high(0); pause(50);} if(grid[0][0] + k) high(1); while(1) pause(100);}
