// Read by LeakSanitizer where it is linked in. OpenImageIO's PNG reader asks for its own error text before libpng's
// longjmp, which passes over that string's destructor: 31 bytes for each damaged picture. Assimp leaves behind an array
// of a damaged mesh.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:OpenImageIO_v2_4::ImageInput::geterror\nleak:libassimp\n";
}
