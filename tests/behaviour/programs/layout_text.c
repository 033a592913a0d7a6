#include "simpletools.h"
int main()
{
	int a = 5;	// tab
	printf("a\tb\n");
	if (a) {
		printf("x	y\n");	/* a tab in the text */
	}
	while(1) {
		printf("%d\n", a += 30000);	pause(10);
	}
}
