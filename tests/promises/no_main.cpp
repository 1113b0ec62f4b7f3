// The code blocks of the README are linked to this: that they build is the claim.
int main() { return 0; }
