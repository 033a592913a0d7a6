/* Bytes that say that they are bytes, and texts. */
unsigned char bytes[6];
char text[] = "abc";
char letter = 'x';
int x;

int main(void)
{
  x = (short)((bytes[1] << 8) + bytes[0]);
  x = text[0] - 'a';
}
