// Puts blob.espl of the build folder into the image: far faster to compile than a list of numbers.
asm(R"(
    .section .blobs, "a"
    .balign 4
    .byte 0
    .global firmware_blob, firmware_blob_end
firmware_blob:
    .incbin "blob.espl"
firmware_blob_end:
    .previous
)");
