;;; rapid-mode.el --- ABB RAPID with rapidc  -*- lexical-binding: t; -*-

;; Font lock, indentation, and eglot with `rapidc lsp'.  Works with Emacs 28 and newer:
;;
;;   (add-to-list 'load-path "/path/to/editors/emacs")
;;   (require 'rapid-mode)

;;; Code:

(defgroup rapid nil "ABB RAPID." :group 'languages)
(defcustom rapid-indent 3 "Columns of a level." :type 'integer :safe #'integerp)
(defcustom rapid-program "rapidc" "The rapidc executable." :type 'string)

(defvar rapid-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?! "<" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\" "\"" table)
    (modify-syntax-entry ?\\ "." table)
    (modify-syntax-entry ?_ "w" table)
    (modify-syntax-entry ?% "." table)
    table))

(defconst rapid--control '("IF" "THEN" "ELSEIF" "ELSE" "ENDIF" "TEST" "CASE" "DEFAULT" "ENDTEST" "FOR" "FROM" "TO" "STEP" "DO" "ENDFOR" "WHILE" "ENDWHILE" "BREAK" "CONTINUE" "ERROR" "UNDO" "BACKWARD" "RAISE" "RETRY" "TRYNEXT" "RETURN" "EXIT" "GOTO" "CONNECT" "WITH"))
(defconst rapid--structure '("MODULE" "ENDMODULE" "PROC" "ENDPROC" "FUNC" "ENDFUNC" "TRAP" "ENDTRAP" "RECORD" "ENDRECORD" "ALIAS"))
(defconst rapid--storage '("LOCAL" "VAR" "PERS" "CONST" "INOUT" "SYSMODULE" "NOVIEW" "NOSTEPIN" "VIEWONLY" "READONLY" "TASK"))
(defconst rapid--operators '("AND" "OR" "XOR" "NOT" "DIV" "MOD" "TRUE" "FALSE"))

(defconst rapid-font-lock-keywords
  `(("![!@].*$" 0 font-lock-doc-face t)
    (,(regexp-opt rapid--control 'words) . font-lock-keyword-face)
    (,(regexp-opt rapid--structure 'words) . font-lock-keyword-face)
    (,(regexp-opt rapid--storage 'words) . font-lock-builtin-face)
    (,(regexp-opt rapid--operators 'words) . font-lock-constant-face)
    ("\\<\\(?:PROC\\|TRAP\\)\\s-+\\(\\w+\\)" 1 font-lock-function-name-face)
    ("\\<FUNC\\s-+\\(\\w+\\)\\s-+\\(\\w+\\)" (1 font-lock-type-face) (2 font-lock-function-name-face))
    ("\\<\\(?:VAR\\|PERS\\|CONST\\|ALIAS\\)\\s-+\\(\\w+\\)\\s-+\\(\\w+\\)"
     (1 font-lock-type-face) (2 font-lock-variable-name-face))
    ("\\\\\\s-*\\(\\w+\\)" 1 font-lock-variable-name-face)
    ("^\\s-*\\(\\w+\\)\\s-*:\\(?:[^=]\\|$\\)" 1 font-lock-constant-face)))

(defconst rapid--opens
  (concat "^\\s-*\\(?:\\(?:MODULE\\|\\(?:LOCAL\\s-+\\)?\\(?:PROC\\|FUNC\\|TRAP\\|RECORD\\)"
          "\\|TEST\\|CASE\\|ERROR\\|UNDO\\|BACKWARD\\)\\>"
          "\\|ELSE\\s-*\\(?:!.*\\)?$\\|DEFAULT\\s-*:"
          "\\|\\(?:IF\\|ELSEIF\\)\\>.*\\<THEN\\s-*\\(?:!.*\\)?$"
          "\\|\\(?:FOR\\|WHILE\\)\\>.*\\<DO\\s-*\\(?:!.*\\)?$\\)"))
(defconst rapid--closes
  (concat "^\\s-*\\(?:\\(?:END\\(?:MODULE\\|PROC\\|FUNC\\|TRAP\\|RECORD\\|IF\\|FOR\\|WHILE\\|TEST\\)"
          "\\|ELSE\\|ELSEIF\\|CASE\\|ERROR\\|UNDO\\|BACKWARD\\)\\>\\|DEFAULT\\s-*:\\)"))

(defun rapid--line-matches (regexp)
  "Whether the line at point matches REGEXP."
  (save-excursion
    (beginning-of-line)
    (let ((case-fold-search t)) (looking-at regexp))))

(defun rapid--indentation ()
  "Column of the line at point."
  (save-excursion
    (beginning-of-line)
    (let ((closes (rapid--line-matches rapid--closes)))
      (if (/= 0 (forward-line -1)) 0
        (while (and (looking-at "^\\s-*$") (= 0 (forward-line -1))))
        (let ((column (current-indentation)))
          (when (rapid--line-matches rapid--opens) (setq column (+ column rapid-indent)))
          (when closes (setq column (- column rapid-indent)))
          (max 0 column))))))

(defun rapid-indent-line ()
  "Indent the line at point."
  (interactive)
  (let ((column (rapid--indentation)))
    (if (<= (current-column) (current-indentation)) (indent-line-to column)
      (save-excursion (indent-line-to column)))))

;;;###autoload
(define-derived-mode rapid-mode prog-mode "RAPID"
  "Major mode for ABB RAPID."
  (setq-local comment-start "! " comment-start-skip "!+@?\\s-*" comment-end "")
  (setq-local font-lock-defaults '(rapid-font-lock-keywords nil t))
  (setq-local indent-line-function #'rapid-indent-line indent-tabs-mode nil)
  (setq-local compile-command
              (concat rapid-program " check " (shell-quote-argument (or buffer-file-name ".")))))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.\\(?:mod\\|sys\\)x\\'" . rapid-mode))
;; .mod and .sys are other things, too: only with a module inside.
;;;###autoload
(add-to-list 'magic-mode-alist '("\\s-*\\(?:%%%\\|MODULE\\s-+\\w+\\)" . rapid-mode))

(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs (cons 'rapid-mode (list rapid-program "lsp"))))

;; The debugger: M-x dape, then rapidc (Emacs 29+).
(defvar dape-configs)
(with-eval-after-load 'dape
  (add-to-list 'dape-configs
               `(rapidc modes (rapid-mode) command ,rapid-program command-args ("dap")
                        :type "rapidc" :request "launch" :program dape-buffer-default :cwd dape-cwd)))

(provide 'rapid-mode)
;;; rapid-mode.el ends here
