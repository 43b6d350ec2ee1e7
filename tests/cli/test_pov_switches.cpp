#include "translated.hpp"

#include "celltrace/error.hpp"

using Catch::Matchers::Contains;
using celltrace::cli::translate_pov_switches;
using celltrace::test::Arguments;
using celltrace::test::notes;
using celltrace::test::translated;

TEST_CASE("a scene alone means render") {
  CHECK(translated({"a.pov"}) == Arguments{"a.pov"});
  CHECK(translated({"render", "a.pov"}) == Arguments{"a.pov"});
  CHECK(translated({"+Ia.pov"}) == Arguments{"a.pov"});
  CHECK(translated({"--quiet", "a.pov"}) == Arguments{"--quiet", "a.pov"});
}

TEST_CASE("other commands are left alone") {
  for (const Arguments& arguments :
       {Arguments{}, Arguments{"compare", "+a.png", "-D"}, Arguments{"spu", "p.elf", "+W640", "-D"},
        Arguments{"--version"}, Arguments{"--help"}, Arguments{"-h"}})
    CHECK(translate_pov_switches(arguments).arguments == arguments);
}

TEST_CASE("a command line as POV-Ray's users write it") {
  CHECK(translated({"+W800", "+H600", "+Iscenes/a.pov", "+Oout.png", "+L/usr/inc", "+WT4", "+Q9", "-A",
                    "+FN8"}) == Arguments{"-W", "800", "-H", "600", "scenes/a.pov", "--pov-output", "out.png",
                                          "-L", "/usr/inc", "--spes", "4", "--quality", "9", "--picture",
                                          "on", "--file-type", "png", "--bits", "8"});
  CHECK(translated({"Width=32", "height=16", "Input_File_Name=a.pov", "Output_File_Name=b.png",
                    "Library_Path=l", "Declare=A=1", "Work_Threads=2", "Antialias=off", "Quality=11",
                    "Output_File_Type=N"}) == Arguments{"-W", "32", "-H", "16", "a.pov", "--pov-output",
                                                        "b.png", "-L", "l", "--declare", "A=1", "--spes", "2",
                                                        "--quality", "11", "--file-type", "png"});
}

TEST_CASE("switches are read in either case and with either sign") {
  CHECK(translated({"-w32", "+h16", "-ia.pov", "-ob.png"}) ==
        Arguments{"-W", "32", "-H", "16", "a.pov", "--pov-output", "b.png"});
}

TEST_CASE("extensions are added as POV-Ray adds them") {
  // The picture's depends on its type.
  CHECK(translated({"+Iscene", "+Opicture"}) == Arguments{"scene.pov", "--pov-output", "picture"});
  CHECK(translated({"+Ia.b/scene", "+Oout/"}) == Arguments{"a.b/scene.pov", "--pov-output", "out/"});
}

TEST_CASE("harmless switches are ignored with a note") {
  const Arguments harmless = {"+D",
                              "-D",
                              "+DGT",
                              "+P",
                              "-P",
                              "+BM1",
                              "+X10",
                              "+B64",
                              "+BP",
                              "Bounding_Threshold=3",
                              "+MB10",
                              "+WL5",
                              "+UV",
                              "-UL",
                              "Field_Render=off",
                              "+BS16",
                              "+SP64",
                              "+HR",
                              "Display=off",
                              "Test_Abort=on",
                              "+GIa",
                              "+RP2",
                              "+MI128",
                              "+BM2",
                              "Odd_Field=off",
                              "-UF",
                              "+UO",
                              "+TH",
                              "Dither=off",
                              "Dither_Method=FS",
                              "+RS2",
                              "-RTR",
                              "+RVP",
                              "+RFa.rca",
                              "Real_Time_Raytracing=off",
                              "+DV",
                              "+GP",
                              "Palette=3",
                              "Video_Mode=1",
                              "Clockless_Animation=off",
                              "-RFI",
                              "+SU",
                              "BSP_MaxDepth=16",
                              "BSP_MissChance=0.3",
                              "Render_Block_Step=1",
                              "Display_Gamma=sRGB",
                              "Radiosity_To_File=off",
                              "Radiosity_From_File=off",
                              "Radiosity_Vain_Pretrace=off",
                              "Radiosity_File_Name=a b.rca",
                              "Pre_Scene_Return=I",
                              "Post_Frame_Return=-S",
                              "Fatal_Error_Return=I",
                              "Antialias_Confidence=0.9",
                              "Create_Continue_Trace_Log=on",
                              "Max_Image_Buffer_Memory=128",
                              "Preview_Start_Size=8",
                              "Test_Abort_Count=5",
                              "Buffer_Size=64",
                              "Pre_Scene_Command=rm -rf x",
                              "Post_Frame_Command=\"mv %s x\""};
  for (const std::string& text : harmless) {
    CAPTURE(text);
    CHECK(translated({text, "a.pov"}) == Arguments{"a.pov"});
    CHECK(notes({text, "a.pov"}) == 1);
  }
  CHECK_THAT(translate_pov_switches({"-D", "a.pov"}).notes.at(0), Contains("'-D' has no effect here"));
  CHECK(notes({"+W640", "-A", "+A0.3", "+R3", "-J", "-UA", "+Q9", "a.pov"}) == 0);
}

TEST_CASE("switches that would change the picture are refused by name") {
  CHECK_THROWS_WITH(translate_pov_switches({"Clockless_Animation=on", "a.pov"}),
                    Contains("'Clockless_Animation=on'") && Contains("not supported yet"));
  for (const std::string text : {"+FS", "Output_File_Type=X", "+FTg", "+FNx", "+FN16g"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(translate_pov_switches({text, "a.pov"}), Contains("'" + text + "'"));
  }
}

TEST_CASE("commands of the shell are never run") {
  CHECK_THAT(translate_pov_switches({"Post_Scene_Command=touch x", "a.pov"}).notes.at(0),
             Contains("'Post_Scene_Command=touch x' is not run"));
}

TEST_CASE("unknown and unfinished switches are refused by name") {
  for (const std::string text : {"+Z",
                                 "+Y7",
                                 "+Pause",
                                 "+Jx",
                                 "Depth=5",
                                 "+W",
                                 "+Wx",
                                 "+I",
                                 "+O",
                                 "+L",
                                 "+Q",
                                 "Width=",
                                 "+S6",
                                 "+Ax",
                                 "+R",
                                 "+AM",
                                 "+SC",
                                 "+ECx",
                                 "+K",
                                 "+Kinf",
                                 "Antialias_Gamma=no",
                                 "+W0",
                                 "+W-12",
                                 "+H.9e2",
                                 "Width=0x10",
                                 "+BS",
                                 "+KC1",
                                 "+UA1",
                                 "Declare=X",
                                 "Declare=X=",
                                 "Declare==1",
                                 "Declare=1X=2",
                                 "Declare=a-b=1",
                                 "Declare=sphere=1",
                                 "Declare=X=1e400",
                                 "File_Gamma=0",
                                 "File_Gamma=x",
                                 "++W20",
                                 "+-W20",
                                 "+",
                                 "-",
                                 "+1",
                                 "+A-1",
                                 "+A5"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(translate_pov_switches({text, "a.pov"}), Contains("'" + text + "'"));
  }
}

TEST_CASE("antialiasing as POV-Ray's switches say it") {
  CHECK(translated({"+A"}) == Arguments{"--antialias", "0.3", "--antialias-jitter", "1"});
  CHECK(translated({"+A0.1", "-J"}) == Arguments{"--antialias", "0.1"});
  CHECK(translated({"-J", "+R4", "+AM2", "+A"}) ==
        Arguments{"--antialias", "0.3", "--antialias-method", "2", "--antialias-depth", "4"});
  CHECK(translated({"+A", "+J0.5"}) == Arguments{"--antialias", "0.3", "--antialias-jitter", "0.5"});
  CHECK(translated({"Antialias=on", "Antialias_Threshold=0.2", "Jitter=off", "Antialias_Depth=2",
                    "Sampling_Method=2", "Antialias_Gamma=2.2"}) ==
        Arguments{"--antialias", "0.2", "--antialias-method", "2", "--antialias-depth", "2",
                  "--antialias-gamma", "2.2"});
  CHECK(translated({"Antialias=on", "Jitter_Amount=0.7"}) ==
        Arguments{"--antialias", "0.3", "--antialias-jitter", "0.7"});
  // The last one counts, and nothing without +A.
  CHECK(translated({"+A0.3", "-A"}).empty());
  CHECK(translated({"+J", "+R3", "+AM1"}).empty());
  CHECK(translated({"+A", "+AM0"}).empty());
  // POV-Ray takes the nearest that there is.
  CHECK(translated({"+A", "+R0", "+AM3", "+J2"}) == Arguments{"--antialias", "0.3", "--antialias-method", "2",
                                                              "--antialias-depth", "1", "--antialias-jitter",
                                                              "1"});
  CHECK(translated({"+A", "+R12", "+J-1"}) == Arguments{"--antialias", "0.3", "--antialias-depth", "9"});
}

TEST_CASE("regions, quality, clock, file types") {
  CHECK(translated({"+SC0.25", "+EC20", "Start_Row=3", "End_Row=0.5"}) ==
        Arguments{"--start-column", "0.25", "--end-column", "20", "--start-row", "3", "--end-row", "0.5"});
  CHECK(translated({"+Q4", "+K0.5"}) == Arguments{"--quality", "4", "--clock", "0.5"});
  CHECK(translated({"+Q12"}) == Arguments{"--quality", "11"});
  CHECK(translated({"-F"}) == Arguments{"--picture", "off"});
  CHECK(translated({"+FP", "Output_to_File=off"}) == Arguments{"--picture", "off", "--file-type", "ppm"});
  CHECK(translated({"+FE", "+O-"}) ==
        Arguments{"--picture", "on", "--file-type", "exr", "--pov-output", "-"});
  CHECK(translated({"Output_File_Type=H"}) == Arguments{"--file-type", "hdr"});
  CHECK(translated({"+FT"}) == Arguments{"--picture", "on", "--file-type", "tga"});
  CHECK(translated({"+FC"}) == Arguments{"--picture", "on", "--file-type", "tga", "--compression", "rle"});
  CHECK(translated({"+FC", "+FB8"}) == Arguments{"--picture", "on", "--file-type", "bmp"});
  CHECK(translated({"+FJ85", "Compression=70"}) ==
        Arguments{"--picture", "on", "--file-type", "jpeg", "--jpeg-quality", "70"});
  CHECK(translated({"Compression=5"}).empty());
  CHECK(translated({"+FN5"}) == Arguments{"--picture", "on", "--file-type", "png", "--bits", "8"});
  CHECK(translated({"+FN8", "Grayscale_Output=on"}) ==
        Arguments{"--picture", "on", "--file-type", "png", "--grey", "on"});
  CHECK(translated({"+FNg"}) == Arguments{"--picture", "on", "--file-type", "png", "--grey", "on"});
  CHECK(translated({"Grayscale_Output=on"}) == Arguments{"--grey", "on"});
  CHECK(translated(
            {"+FNg", "Grayscale_Output=off", "File_Gamma=2.2", "File_Gamma=sRGB", "Bits_Per_Colour=10"}) ==
        Arguments{"--picture", "on", "--file-type", "png", "--bits", "16"});
  CHECK(translated({"File_Gamma=1.8"}) == Arguments{"--file-gamma", "1.8"});
  CHECK(translated({"+V"}) == Arguments{"--verbose", "on"});
  CHECK(translated({"Verbose=false"}) == Arguments{"--verbose", "off"});
  CHECK(translated({"+UA"}) == Arguments{"--alpha", "on"});
  CHECK(translated({"Output_Alpha=on", "-UA"}) == Arguments{"--alpha", "off"});
  CHECK_THROWS_WITH(translate_pov_switches({"+UA1", "a.pov"}), Contains("'+UA1'"));
  CHECK(translated({"+FN16"}) == Arguments{"--picture", "on", "--file-type", "png", "--bits", "16"});
  CHECK(translated({"+FN16", "+FP8"}) == Arguments{"--picture", "on", "--file-type", "ppm", "--bits", "8"});
  CHECK(translated({"Output_File_Type=P", "Bits_Per_Color=16"}) ==
        Arguments{"--file-type", "ppm", "--bits", "16"});
  CHECK(translated({"+MV3.1"}) == Arguments{"--language-version", "3.1"});
  CHECK(translated({"Version=3.7"}) == Arguments{"--language-version", "3.7"});
}

TEST_CASE("of what is repeated the last counts") {
  CHECK(translated({"+W10", "+H20", "+W30"}) == Arguments{"-W", "30", "-H", "20"});
  CHECK(translated({"+Ia.pov", "+W10", "+Ib"}) == Arguments{"b.pov", "-W", "10"});
  CHECK(translated({"+Ia.pov", "c.pov"}) == Arguments{"c.pov"});
  CHECK(translated({"a.pov", "b.pov"}) == Arguments{"b.pov"});
  CHECK(translated({"+Ia.pov", "--quiet", "-W", "8"}) == Arguments{"a.pov", "--quiet", "-W", "8"});
  // Among celltrace's own options the order stays.
  CHECK(translated({"+W10", "-W", "20", "+W30"}) == Arguments{"-W", "10", "-W", "20", "-W", "30"});
  CHECK(translated({"+La", "+Lb", "Declare=A=1", "Declare=B=2"}) ==
        Arguments{"-L", "a", "-L", "b", "--declare", "A=1", "--declare", "B=2"});
}

TEST_CASE("declarations") {
  CHECK(translated({"Declare=X=+1", "Declare=Y=1e-3", "Declare=Z=.5"}) ==
        Arguments{"--declare", "X=1", "--declare", "Y=0.001", "--declare", "Z=0.5"});
  CHECK(translated({"Declare=X=\"te xt\"", "Declare='Y=\"5\"'", "Declare=\"Z=5\"", "Declare=W=text"}) ==
        Arguments{"--declare", "X=\"te xt\"", "--declare", "Y=\"5\"", "--declare", "Z=5", "--declare",
                  "W=text"});
  CHECK(translated({"Declare=X=1,2"}) == Arguments{"--declare", "X=1"});
  CHECK(notes({"Declare=X=1,2"}) == 1);
  // As in POV-Ray, the first one counts.
  CHECK(translated({"Declare=X=2", "Declare=X=3"}) == Arguments{"--declare", "X=2"});
  CHECK(notes({"Declare=X=2", "Declare=X=3"}) == 1);
  CHECK(translated({"Declare=clock=2", "Declare=clock=3"}) ==
        Arguments{"--declare", "clock=2", "--declare", "clock=3"});
}

TEST_CASE("streams of messages") {
  CHECK(translated({"+GAa b.txt", "Debug_File=\"d.txt\"", "Statistic_File=on", "Append_File=on"}) ==
        Arguments{"--message-file", "all=a b.txt", "--message-file", "debug=d.txt", "--message-file",
                  "statistics=stats.out", "--append-messages", "on"});
  CHECK(translated({"All_File=a.txt", "All_File=off"}).empty());
  CHECK(translated({"-GW", "Debug_Console=off", "+GD"}) == Arguments{"--hide", "warning"});
  CHECK(translated({"-GAa.txt"}) == Arguments{"--hide", "all", "--message-file", "all=a.txt"});
  CHECK(translated({"-GF"}).empty());
  CHECK(notes({"-GF"}) == 1);
}

TEST_CASE("options stand where the last of what they are made of stood") {
  // Words before and after may be options that a user's files and environment hold.
  CHECK(translated({"Antialias=on", "--antialias", "0.1"}) ==
        Arguments{"--antialias", "0.3", "--antialias-jitter", "1", "--antialias", "0.1"});
  CHECK(translated({"Antialias=on", "--antialias", "0.1", "+A0.2", "-J"}) ==
        Arguments{"--antialias", "0.1", "--antialias", "0.2"});
}

TEST_CASE("celltrace's own options and their values pass through") {
  const Arguments own = {"-o",  "+x.png", "-W", "8",           "--stats", "-",    "--declare",
                         "x=1", "--seed", "+5", "--cache=off", "--quiet", "a.pov"};
  CHECK(translated(own) == own);
  CHECK(translated({"--quiet", "+W8"}) == Arguments{"--quiet", "-W", "8"});
  CHECK(translated({"--faults", "+W8"}) == Arguments{"--faults", "-W", "8"});
  CHECK(translated({"--trace", "+t.json", "+W8"}) == Arguments{"--trace", "+t.json", "-W", "8"});
  CHECK(translated({"--cache=off", "+W8"}) == Arguments{"--cache=off", "-W", "8"});
  CHECK(translated({"+W8", "--", "+W8", "-o"}) == Arguments{"-W", "8", "--", "+W8", "-o"});
  CHECK(translated({"./a=b.pov"}) == Arguments{"./a=b.pov"});
  CHECK(translated({"a.pov", "-h"}) == Arguments{"a.pov", "-h"});
}
