# The comment after #pragma once is the file's; other // comments belong to what follows, or to what they follow.
/^#pragma once/{n;s,^//,/// \\file\n///,}
s,^( *)//( |$),\1///\2,
s,([;\,{}] *)// ,\1///< ,
